// A program built without MPI: one process.
#include <cstdlib>
#include <initializer_list>

#include "formats/input_error.hpp"
#include "tool/run/cluster.hpp"

namespace contact::tool {

Cluster::Cluster(int& /*argc*/, char**& /*argv*/) {
  for (const char* const size : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* const processes = std::getenv(size); processes != nullptr && std::atoi(processes) > 1)
      throw formats::InputError({"mpirun", 0}, "",
                                "this program knows nothing of MPI, and each of the " + std::string(processes) +
                                    " processes would do all the work: take contact-oracle-mpi");
}
Cluster::~Cluster() = default;

std::uint64_t Cluster::size() { return 1; }
bool Cluster::is_first() { return true; }

void Cluster::in_order(std::uint64_t count, const std::function<std::string(std::uint64_t)>& work,
                       const std::function<void(std::uint64_t, std::string)>& take) {
  for (std::uint64_t i = 0; i < count; ++i) take(i, work(i));
}

void Cluster::end_all(int /*exit*/) {}

}  // namespace contact::tool
