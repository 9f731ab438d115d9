// The processes that share a run's work: those that mpirun started, or this one alone.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace contact::tool {

class Cluster {
 public:
  /// One a program, while it does anything. Throws formats::InputError where mpirun started several processes of a
  /// program built without MPI: each would do all the work.
  Cluster(int& argc, char**& argv);
  Cluster(const Cluster&) = delete;
  Cluster& operator=(const Cluster&) = delete;
  ~Cluster();

  [[nodiscard]] static std::uint64_t size();
  /// Whether this process is the one that reads, writes and prints for all.
  [[nodiscard]] static bool is_first();

  /// work(0), work(1), ... work(count - 1), each in one of the processes; the first process is given what they return,
  /// in this order. Few results wait in memory, however many there are.
  static void in_order(std::uint64_t count, const std::function<std::string(std::uint64_t)>& work,
                       const std::function<void(std::uint64_t, std::string)>& take);

  /// Ends the other processes, where there are any: this one cannot go on. With several, does not return.
  static void end_all(int exit);
};

}  // namespace contact::tool
