// Plug-ins: shared libraries that bring model types and intersectors at run time.
#include "contact/plugin.hpp"

#include <cxxabi.h>
#include <dlfcn.h>

#include <mutex>
#include <set>
#include <string>

namespace contact::inline CONTACT_ABI {
namespace {

constexpr const char* kEntry = "contact_plugin_entry";

/// What the system says of the last failure, without the file's name that it begins with.
std::string system_message(const std::string& file) {
  const char* text = dlerror();
  std::string message = text ? text : "unknown reason";
  if (message.starts_with(file + ": ")) message.erase(0, file.size() + 2);
  return message;
}

}  // namespace

void load_plugin(const std::filesystem::path& library) {
  static std::mutex mutex;
  static std::set<void*> loaded;  // the system has one handle for one library, whatever the path
  const std::lock_guard lock(mutex);
  const auto refuse = [&](const std::string& problem) { throw PluginError(library.string() + ": " + problem); };

  if (library.empty()) refuse("names no file");
  if (library.string().find('\0') != std::string::npos) refuse("a file's name holds no zero byte");
  std::error_code unknown;
  const std::string file = std::filesystem::absolute(library, unknown).string();  // a bare name would be searched for
  if (unknown) refuse("cannot be found: " + unknown.message());
  // An exception from a constructor in there would leave the system's loader locked: it ends the program here.
  void* const opened = [&]() noexcept { return dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL); }();
  if (!opened) refuse("cannot be loaded: " + system_message(file));
  if (loaded.contains(opened)) return;
  const auto* const entry = static_cast<const PluginEntry*>(dlsym(opened, kEntry));
  if (!entry) {
    dlclose(opened);
    refuse("is no plug-in: it exports no " + std::string(kEntry));
  }
  if (const int interface = entry->interface; interface != kPluginInterface) {
    dlclose(opened);
    refuse("was built for plug-in interface " + std::to_string(interface) + ", this is " +
           std::to_string(kPluginInterface));
  }
  if (!entry->enter) {
    dlclose(opened);
    refuse("exports no function to register with");
  }
  // From here on it is never closed, whatever happens: factories hold creators whose code lives there.
  PluginHost host{IntersectorFactory::getInstance(), ModelFactory::getInstance()};
  try {
    entry->enter(host);
  } catch (const std::exception& error) {
    refuse("failed to register: " + std::string(error.what()));
  } catch (const abi::__forced_unwind&) {
    throw;  // a thread that is cancelled, which must not be held up
  } catch (...) {
    refuse("failed to register: what it threw is no std::exception");
  }
  loaded.insert(opened);
}

}  // namespace contact::inline CONTACT_ABI
