// The processes that mpirun started, through Boost.MPI.
#include <unistd.h>

#include <atomic>
#include <boost/mpi/communicator.hpp>
#include <boost/mpi/environment.hpp>
#include <boost/mpi/request.hpp>
#include <boost/serialization/string.hpp>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <optional>
#include <thread>

#include "tool/run/cluster.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

// MPI is started only where mpirun started us: alone it would cost every command a tenth of a second.
std::unique_ptr<boost::mpi::environment> environment;
std::optional<boost::mpi::communicator> world;

constexpr std::chrono::milliseconds kLook{1};
constexpr std::chrono::milliseconds kWatch{20};

/// Waits in steps, so that a signal ends the wait.
void wait(boost::mpi::request request) {
  while (!request.test()) {
    throw_if_interrupted();
    std::this_thread::sleep_for(kLook);
  }
}

/// Ends this process as soon as its parent, mpirun or its daemon, has ended. MPI notices that later, and never where it
/// is just starting.
class WatchOfParent {
 public:
  WatchOfParent()
      : watch_([this, parent = ::getppid()] {
          while (!over_) {
            if (::getppid() != parent) std::_Exit(kInterrupted);
            std::this_thread::sleep_for(kWatch);
          }
        }) {}
  WatchOfParent(const WatchOfParent&) = delete;
  WatchOfParent& operator=(const WatchOfParent&) = delete;
  ~WatchOfParent() {
    over_ = true;
    watch_.join();
  }

 private:
  std::atomic<bool> over_ = false;
  std::thread watch_;
};

std::unique_ptr<WatchOfParent> watch;

}  // namespace

Cluster::Cluster(int& argc, char**& argv) {
  if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr && std::getenv("PMI_SIZE") == nullptr) return;
  watch = std::make_unique<WatchOfParent>();
  environment = std::make_unique<boost::mpi::environment>(argc, argv, boost::mpi::threading::funneled);
  world.emplace();
}

Cluster::~Cluster() {
  world.reset();
  environment.reset();
  watch.reset();
}

std::uint64_t Cluster::size() { return world ? static_cast<std::uint64_t>(world->size()) : 1; }
bool Cluster::is_first() { return !world || world->rank() == 0; }

void Cluster::in_order(std::uint64_t count, const std::function<std::string(std::uint64_t)>& work,
                       const std::function<void(std::uint64_t, std::string)>& take) {
  // Piece i is made by process i modulo their number. Each sends one and makes the next; the first takes them in turn.
  const auto mine = static_cast<std::uint64_t>(world ? world->rank() : 0);
  std::string sent;
  std::optional<boost::mpi::request> sending;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t by = i % size();
    if (by == mine) {
      std::string made = work(i);
      if (mine == 0) {
        take(i, std::move(made));
        continue;
      }
      if (sending) wait(*sending);
      sent = std::move(made);
      sending = world->isend(0, 0, sent);
    } else if (mine == 0) {
      std::string received;
      wait(world->irecv(static_cast<int>(by), 0, received));
      take(i, std::move(received));
    }
  }
  if (sending) wait(*sending);
}

void Cluster::end_all(int exit) {
  if (size() > 1) boost::mpi::environment::abort(exit);
}

}  // namespace contact::tool
