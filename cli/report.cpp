#include "report.h"

#include <algorithm>

namespace wheatstone::cli {

void add_members(Report& report, const Json& object) {
  for (const auto& [key, value] : object.items()) report.facts.push_back({key, value});
}

Json json_of(const Report& report) {
  Json object = Json::object();
  for (const Fact& fact : report.facts)
    if (!fact.key.empty()) object[fact.key] = fact.value;
  return object;
}

std::string lines(const std::string& label, const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : "\n") + label + text;
  return all;
}

std::string json_text(const Json& facts, int indent) {
  return facts.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string one_line(std::string message) {
  const auto is_control = [](unsigned char c) { return c < ' ' || c == 0x7F; };
  std::ranges::replace_if(message, is_control, ' ');
  return message;
}

}  // namespace wheatstone::cli
