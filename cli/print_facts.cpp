#include "print_facts.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>

namespace wheatstone::cli {

std::string json_text(const nlohmann::ordered_json& facts, int indent) {
  return facts.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string one_line(std::string message) {
  const auto is_control = [](unsigned char c) { return c < ' ' || c == 0x7F; };
  std::ranges::replace_if(message, is_control, ' ');
  return message;
}

void print_facts(const nlohmann::ordered_json& facts, const Session& session) {
  session.output << json_text(facts) << '\n';
}

}  // namespace wheatstone::cli
