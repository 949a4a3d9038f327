#include "print_facts.h"

#include <nlohmann/json.hpp>
#include <ostream>

namespace wheatstone::cli {

std::string json_text(const nlohmann::ordered_json& facts, int indent) {
  return facts.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void print_facts(const nlohmann::ordered_json& facts, const Session& session) {
  session.output << json_text(facts) << '\n';
}

}  // namespace wheatstone::cli
