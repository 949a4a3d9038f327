#include "wheatstone/study/trial_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

#include "wheatstone/error.h"
#include "wheatstone/study/draw_lots_internal.h"
#include "wheatstone/study/latin_square_internal.h"

namespace wheatstone {
namespace {

/// Everything but the subjects that decides on balance.
struct Numbers {
  int subjects;  ///< of one group
  int conditions, repetitions, items;
  int trials() const { return conditions * repetitions; }
};

Numbers numbers_of(const StudyDesign& design) {
  return {design.subjects / group_count(design), condition_count(design), design.repetitions, design.item_count};
}

OrderSquare square_of(TrialOrder order, const Numbers& numbers) {
  const int n = numbers.conditions;
  const bool williams_fits = numbers.subjects % (n % 2 == 0 ? n : 2 * n) == 0;
  const bool williams = order == TrialOrder::williams || (order == TrialOrder::balanced && williams_fits);
  return williams ? williams_square(n) : latin_square(n);
}

std::vector<int> shuffled(int count, Lots lots) {
  std::vector<int> values(static_cast<std::size_t>(count));
  std::iota(values.begin(), values.end(), 0);
  lots.shuffle(std::span<int>(values));
  return values;
}

/// A subject of a group, and what its trials are drawn from.
struct Drawn {
  const StudyDesign& design;
  Numbers numbers;
  int group, member;
  Lots lots(std::uint64_t what) const {
    return Lots({design.seed, static_cast<std::uint64_t>(group), static_cast<std::uint64_t>(member), what});
  }
};

/// The items that a subject meets in each condition. Where each subject meets all items, conditions are dealt out to
/// them in turn, from another one for each subject; over as many subjects as there are conditions, whose beginnings are
/// drawn by lot, each item meets each condition once. Where there are more items, one subject goes on where the one
/// before it stopped.
std::vector<std::vector<int>> items_by_condition(const Drawn& drawn) {
  const auto& [subjects, conditions, repetitions, items] = drawn.numbers;
  std::vector<std::vector<int>> dealt(static_cast<std::size_t>(conditions));
  const bool meets_all = drawn.numbers.trials() == items;
  const std::uint64_t round = static_cast<std::uint64_t>(drawn.member / conditions);
  const std::vector<int> beginnings =
      shuffled(conditions, Lots({drawn.design.seed, static_cast<std::uint64_t>(drawn.group), round, 0x6974656d}));
  const int beginning = meets_all ? beginnings[static_cast<std::size_t>(drawn.member % conditions)] : 0;
  for (int i = 0; i < drawn.numbers.trials(); ++i) {
    const int counted = drawn.member * drawn.numbers.trials() + i;
    const int item = meets_all ? i : counted % items;
    dealt[static_cast<std::size_t>(((meets_all ? i : counted) + beginning) % conditions)].push_back(item);
  }
  Lots lots = drawn.lots(1);
  for (std::vector<int>& of_condition : dealt) lots.shuffle(std::span<int>(of_condition));
  return dealt;
}

std::vector<int> order_of_round(const Drawn& drawn, int round) {
  if (drawn.design.order == TrialOrder::random)
    return shuffled(drawn.numbers.conditions, drawn.lots(100 + static_cast<std::uint64_t>(round)));
  const OrderSquare square = square_of(drawn.design.order, drawn.numbers);
  return square[static_cast<std::size_t>(drawn.member + round) % square.size()];
}

std::vector<PlannedTrial> practice_trials(const StudyDesign& design, int conditions) {
  std::vector<PlannedTrial> trials;
  for (int i = 0; i < design.practice; ++i) {
    // Pictures are practised with some of those that are rated.
    const int item = design.items.empty() ? design.item_count + i : i % design.item_count;
    trials.push_back({.practice = true, .condition = i % conditions, .item = item, .place = 0});
  }
  return trials;
}

/// Trials as they are counted: [condition][place], and so on.
using Counts = std::map<std::pair<int, int>, int>;

bool are_equal(const Counts& counts, std::size_t cells) {
  if (counts.size() != cells) return false;
  return std::ranges::all_of(counts, [&](const auto& count) { return count.second == counts.begin()->second; });
}

DesignBalance balance_of_group(const StudyDesign& design, int group) {
  const Numbers numbers = numbers_of(design);
  const auto conditions = static_cast<std::size_t>(numbers.conditions);
  Counts positions, follows, items;
  for (int member = 0; member < numbers.subjects; ++member) {
    int before = -1;
    for (const PlannedTrial& trial : plan_trials(design, member * group_count(design) + group)) {
      if (trial.practice) continue;
      ++positions[{trial.condition, trial.place}];
      if (before >= 0 && trial.place > 0 && before != trial.condition) ++follows[{before, trial.condition}];
      ++items[{trial.item, trial.condition}];
      before = trial.condition;
    }
  }
  return {are_equal(positions, conditions * conditions),
          conditions == 1 || are_equal(follows, conditions * (conditions - 1)),
          are_equal(items, static_cast<std::size_t>(numbers.items) * conditions)};
}

/// How many subjects, or items, the balance needs a multiple of.
std::string nearest_multiples(int number, int multiple) {
  const int below = number / multiple * multiple;
  if (below == 0) return fmt::format("{}", multiple);
  return fmt::format("{} or {}", below, below + multiple);
}

bool items_balance(const StudyDesign& design, int subjects, int items) {
  StudyDesign changed = design;
  changed.subjects = subjects;
  changed.item_count = items;
  return count_balance(changed).items;
}

/// The nearest number that satisfies, from `step` away on; none within 400 steps.
template <class Satisfies>
std::optional<int> nearest_number(int from, int step, Satisfies satisfies) {
  for (int away = 1; away <= 400; ++away) {
    if (satisfies(from + away * step)) return from + away * step;
    if (from - away * step > 0 && satisfies(from - away * step)) return from - away * step;
  }
  return {};
}

void check_items(const StudyDesign& design, std::string_view name, int subject_step) {
  if (count_balance(design).items) return;
  const Numbers numbers = numbers_of(design);
  const auto subjects = nearest_number(design.subjects, subject_step,
                                       [&](int count) { return items_balance(design, count, design.item_count); });
  const auto items = nearest_number(design.item_count, 1, [&](int count) {
    return count >= numbers.trials() && count < 3 * design.item_count && items_balance(design, design.subjects, count);
  });
  std::string can;
  if (subjects) can += fmt::format("{} subjects", *subjects);
  if (items) can += fmt::format("{}{} items", can.empty() ? "" : " or ", *items);
  throw Error(ErrorKind::bad_input,
              fmt::format("{}: {} items cannot be met equally often in {} conditions by {} subjects; {} can", name,
                          design.item_count, numbers.conditions, design.subjects, can));
}

/// Adds effects of all combinations of the factors from `next` on with those named so far.
void add_effects(const StudyDesign& design, std::size_t next, const DesignEffect& so_far,
                 std::vector<DesignEffect>& effects) {
  const int groups = group_count(design);
  for (std::size_t i = next; i < design.factors.size(); ++i) {
    const StudyFactor& factor = design.factors[i];
    DesignEffect effect = so_far;
    effect.name += (so_far.name.empty() ? "" : ":") + factor.name;
    effect.effect *= static_cast<int>(factor.levels.size()) - 1;
    if (!factor.between) effect.error_subjects *= static_cast<int>(factor.levels.size()) - 1;
    effect.error_items = design.items.empty() ? (design.item_count - 1) * effect.effect : 0;
    DesignEffect counted = effect;
    counted.error_subjects *= design.subjects - groups;
    effects.push_back(counted);
    add_effects(design, i + 1, effect, effects);
  }
}

}  // namespace

int group_of_subject(const StudyDesign& design, int subject) { return subject % group_count(design); }

std::vector<PlannedTrial> plan_trials(const StudyDesign& design, int subject) {
  const int groups = group_count(design);
  const Drawn drawn{design, numbers_of(design), subject % groups, subject / groups};
  std::vector<PlannedTrial> trials = practice_trials(design, drawn.numbers.conditions);
  const std::vector<std::vector<int>> items = items_by_condition(drawn);
  const auto add = [&](int condition, int repetition, int place) {
    const int item = items[static_cast<std::size_t>(condition)][static_cast<std::size_t>(repetition)];
    trials.push_back({.condition = condition, .item = item, .place = place});
  };
  const bool rounds = design.arrangement == TrialArrangement::rounds;
  for (int outer = 0; outer < (rounds ? design.repetitions : 1); ++outer) {
    const std::vector<int> order = order_of_round(drawn, outer);
    for (int place = 0; place < drawn.numbers.conditions; ++place)
      for (int inner = 0; inner < (rounds ? 1 : design.repetitions); ++inner)
        add(order[static_cast<std::size_t>(place)], outer + inner, place);
  }
  return trials;
}

DesignBalance count_balance(const StudyDesign& design) {
  DesignBalance all;
  for (int group = 0; group < group_count(design); ++group) {
    const DesignBalance balance = balance_of_group(design, group);
    all.positions &= balance.positions;
    all.follows &= balance.follows;
    all.items &= balance.items;
  }
  return all;
}

void check_balance(const StudyDesign& design, std::string_view name) {
  const int groups = group_count(design);
  const Numbers numbers = numbers_of(design);
  if (design.subjects % groups != 0)
    throw Error(ErrorKind::bad_input, fmt::format("{}: {} subjects cannot be shared equally by {} groups; {} can", name,
                                                  design.subjects, groups, nearest_multiples(design.subjects, groups)));
  if (design.order == TrialOrder::random) return;
  const int n = numbers.conditions;
  const int rows = design.order == TrialOrder::williams && n % 2 == 1 ? 2 * n : n;
  const int multiple = groups * rows;
  if (design.subjects % multiple != 0)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: {} subjects cannot be balanced over {} conditions{}; {} can", name, design.subjects, n,
                            rows != n ? " by Williams squares" : "", nearest_multiples(design.subjects, multiple)));
  check_items(design, name, multiple);
}

std::string order_text(const StudyDesign& design) {
  if (design.order == TrialOrder::random) return "drawn by lot for each subject";
  const Numbers numbers = numbers_of(design);
  const bool williams = square_of(design.order, numbers) != latin_square(numbers.conditions);
  return williams ? fmt::format("Williams squares of {} rows", williams_square(numbers.conditions).size())
                  : fmt::format("Latin squares of {} rows", numbers.conditions);
}

std::vector<DesignEffect> degrees_of_freedom(const StudyDesign& design) {
  std::vector<DesignEffect> effects;
  add_effects(design, 0, {.effect = 1, .error_subjects = 1}, effects);
  return effects;
}

}  // namespace wheatstone
