// What SOFA says goes to standard error, warnings and worse alone: on standard output an engine answers.
#pragma once

#include <sofa/helper/logging/Message.h>
#include <sofa/helper/logging/MessageDispatcher.h>
#include <sofa/helper/logging/MessageHandler.h>

#include <iostream>

namespace contact::sofa_engine {

class StandardError final : public sofa::helper::logging::MessageHandler {
 public:
  void process(sofa::helper::logging::Message& message) override {
    if (message.type() < sofa::helper::logging::Message::Warning) return;
    std::cerr << (message.type() == sofa::helper::logging::Message::Warning ? "SOFA warns: " : "SOFA: ")
              << message.messageAsString() << '\n';
  }
  [[nodiscard]] std::string getName() const override { return "StandardError"; }
};

/// From here on. The handler lives as long as the process, as those that it replaces.
inline void speak_on_standard_error() {
  static StandardError handler;
  sofa::helper::logging::MessageDispatcher::clearHandlers();
  sofa::helper::logging::MessageDispatcher::addHandler(&handler);
}

}  // namespace contact::sofa_engine
