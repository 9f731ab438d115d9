// Plug-ins: shared libraries that bring model types and intersectors at run time.
#define BOOST_DLL_USE_STD_FS
#include "contact/plugin.hpp"

#include <algorithm>
#include <boost/dll/shared_library.hpp>
#include <list>
#include <mutex>

namespace contact {
namespace {

constexpr const char* kEntry = "contact_plugin_entry";

}  // namespace

void load_plugin(const std::filesystem::path& library) {
  // Never unloaded: factories hold creators whose code lives there.
  static std::mutex mutex;
  static auto& loaded = *new std::list<boost::dll::shared_library>;
  const std::lock_guard lock(mutex);
  const auto refuse = [&](const std::string& problem) { throw PluginError(library.string() + ": " + problem); };

  boost::dll::shared_library opened;
  try {
    opened.load(std::filesystem::absolute(library), boost::dll::load_mode::rtld_now);
  } catch (const std::exception& error) {
    refuse(std::string("cannot be loaded: ") + error.what());
  }
  if (std::any_of(loaded.begin(), loaded.end(), [&](const auto& other) { return other.native() == opened.native(); }))
    return;
  if (!opened.has(kEntry)) refuse("is no plug-in: it exports no " + std::string(kEntry));
  const auto& entry = opened.get<const PluginEntry>(kEntry);
  if (entry.interface != kPluginInterface)
    refuse("was built for plug-in interface " + std::to_string(entry.interface) + ", this is " +
           std::to_string(kPluginInterface));
  PluginHost host{IntersectorFactory::getInstance(), ModelFactory::getInstance()};
  entry.enter(host);
  loaded.push_back(std::move(opened));
}

}  // namespace contact
