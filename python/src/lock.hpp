// Python's lock, given back while nothing of Python is touched, and taken again.
#pragma once

#include <Python.h>

#include <chrono>
#include <thread>

#if defined(__GLIBCXX__)
#include <cxxabi.h>
#endif

namespace contact::python {

/// Calls work(), which takes Python's lock. Where the interpreter ends meanwhile, the thread stands still until the
/// process is gone, as of Python 3.14 on. Older ones end the thread by unwinding it, and the first destructor on the
/// way that takes the lock would end the whole program.
template <class Work>
auto unless_python_ends(Work&& work) {
#if defined(__GLIBCXX__)
  try {
    return work();
  } catch (const abi::__forced_unwind&) {
    while (true) std::this_thread::sleep_for(std::chrono::hours(1));
  }
#else
  return work();
#endif
}

/// This thread does not hold the lock while it lives. Domain: it held it before.
class WithoutLock {
 public:
  WithoutLock() : state_(PyEval_SaveThread()) {}
  WithoutLock(const WithoutLock&) = delete;
  WithoutLock& operator=(const WithoutLock&) = delete;
  ~WithoutLock() {
    unless_python_ends([&] { PyEval_RestoreThread(state_); });
  }

 private:
  PyThreadState* state_;
};

/// This thread holds the lock while it lives.
class WithLock {
 public:
  WithLock() : state_(unless_python_ends([] { return PyGILState_Ensure(); })) {}
  WithLock(const WithLock&) = delete;
  WithLock& operator=(const WithLock&) = delete;
  ~WithLock() { PyGILState_Release(state_); }

 private:
  PyGILState_STATE state_;
};

}  // namespace contact::python
