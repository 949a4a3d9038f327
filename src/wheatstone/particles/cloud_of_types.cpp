// Several particle types of a snapshot as one cloud, each with a colour of its own.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/image/colour.h"
#include "wheatstone/particles/columns_internal.h"
#include "wheatstone/particles/snapshot_internal.h"

namespace wheatstone {
namespace {

/// Columns that not all types of particles have.
constexpr std::array columns_of_types{&Cloud::density, &Cloud::temperature, &Cloud::smoothing_length, &Cloud::mass};

/// One type after the other.
struct TypesInTurn {
  std::vector<CloudSource> sources;
  std::vector<TypeColour> colours;
  std::array<bool, columns_of_types.size()> of_all;  // whether every type has a column
  bool some_light_changes = false;
  std::size_t at = 0;

  Cloud next(std::size_t most) {
    for (; at < sources.size(); ++at) {
      Cloud cloud = sources[at].next(most);
      if (cloud.size() == 0) continue;
      for (std::size_t column = 0; column < columns_of_types.size(); ++column)
        if (!of_all[column]) (cloud.*columns_of_types[column]).clear();
      cloud.colour.assign(cloud.size(), colours[at].colour);
      if (some_light_changes) cloud.presence.assign(cloud.size(), colours[at].light);
      return cloud;
    }
    return {};
  }

  void reuse(Cloud used) {
    if (at < sources.size() && sources[at].reuse) sources[at].reuse(std::move(used));
  }

  std::size_t skip(std::size_t most) {
    for (; at < sources.size(); ++at)
      if (const std::size_t skipped = sources[at].skip ? sources[at].skip(most) : sources[at].next(most).size();
          skipped > 0)
        return skipped;
    return 0;
  }
};

/// The first particles of a type, which tell the columns that it has.
Cloud first_of_type(const std::filesystem::path& path, const CloudChoice& choice) {
  constexpr std::size_t tell_the_origin = 1000;
  const CloudSource source = open_cloud(path, choice);
  try {
    return source.next(tell_the_origin);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}, for particles of type '{}'", error.what(), choice.type));
  }
}

/// Throws where no type has one of the condition's quantities, what the first type says.
void check_quantities(const std::filesystem::path& path, const CloudChoice& choice) {
  for (const std::string& name : choice.where->names) {
    CloudChoice of_type = choice;
    of_type.type_colours.clear();
    of_type.where = Condition{{name}, {{Condition::Kind::equal, {{{0, 0}, {0, 0}}}}}};
    std::optional<Error> lacking;
    const bool is_known = std::ranges::any_of(choice.type_colours, [&](const TypeColour& type) {
      of_type.type = type.type;
      try {
        return first_of_type(path, of_type).size() > 0;
      } catch (const Error& error) {
        if (!lacking) lacking = error;
        return false;
      }
    });
    if (!is_known && lacking) throw Error(*lacking);
  }
}

}  // namespace

CloudSource open_types(const std::filesystem::path& path, const CloudChoice& choice) {
  auto types = std::make_shared<TypesInTurn>();
  types->of_all.fill(true);
  if (choice.where) check_quantities(path, choice);
  CloudChoice of_type = choice;
  of_type.type_colours.clear();
  of_type.where_may_lack = true;
  CloudSource source;
  std::uint64_t count = 0;
  std::set<int> numbers;
  for (const TypeColour& type : choice.type_colours) {
    if (!numbers.insert(snapshot_type(type.type)).second)
      throw Error(ErrorKind::wrong_usage, fmt::format("the particle type '{}' has several colours", type.type));
    of_type.type = type.type;
    const Cloud first = first_of_type(path, of_type);
    for (std::size_t column = 0; column < columns_of_types.size(); ++column)
      types->of_all[column] = types->of_all[column] && !(first.*columns_of_types[column]).empty();
    of_type.origin = first.origin;  // one for all types
    CloudSource opened = open_cloud(path, of_type);
    count += opened.count.value_or(0);
    if (types->sources.empty()) {
      source = opened;
      source.fields.clear();
    }
    for (std::string& field : opened.fields)
      if (std::ranges::find(source.fields, field) == source.fields.end()) source.fields.push_back(field);
    types->sources.push_back(std::move(opened));
    types->colours.push_back(type);
    types->some_light_changes = types->some_light_changes || type.light != 1;
  }
  source.count = count;
  source.next = [types](std::size_t most) { return types->next(most); };
  source.reuse = [types](Cloud used) { types->reuse(std::move(used)); };
  source.skip = [types](std::size_t most) { return types->skip(most); };
  return source;
}

std::vector<TypeColour> parse_type_colours(std::string_view text, std::string_view name) {
  constexpr float least_light = 1e-3f, most_light = 1e6f;
  const auto refuse = [&](std::string_view part, std::string_view expected) {
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: is '{}', expected {}", name, part, expected));
  };
  std::vector<TypeColour> types;
  std::string_view rest = text;
  while (true) {
    const std::string_view one = rest.substr(0, rest.find(','));
    const std::size_t sign = one.find('='), colon = std::min(one.find(':', sign), one.size());
    if (sign == std::string_view::npos || sign == 0) refuse(text, "TYPE=COLOUR,... as gas=FFB347:6,stars=FFFFFF");
    TypeColour& type = types.emplace_back();
    type.type = one.substr(0, sign);
    const std::string_view code = one.substr(0, colon).substr(sign + 1);
    const std::optional<Rgb8> colour = colour_of_code(code);
    if (!colour) refuse(code, "a colour as 3366FF");
    type.colour = *colour;
    if (colon < one.size()) {
      const std::optional<double> light = parse_number(one.substr(colon + 1));
      if (!light || !(*light >= least_light && *light <= most_light))
        refuse(one.substr(colon + 1), "a number from 0.001 to 1000000");
      type.light = static_cast<float>(*light);
    }
    if (one.size() == rest.size()) return types;
    rest.remove_prefix(one.size() + 1);
  }
}

}  // namespace wheatstone
