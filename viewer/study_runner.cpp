#include "study_runner.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/multiview/slice_file.h"
#include "wheatstone/painting/two_eyes.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/stereo/fitting_pair.h"
#include "wheatstone/study/draw_graph.h"
#include "wheatstone/study/trial_table.h"

namespace wheatstone::viewer {
namespace {

std::variant<PreparedPainting, SliceStack> read_scene(const std::filesystem::path& path) {
  if (path.extension() == ".exr") return read_slices(path);
  const Painting painting = read_painting(path);
  return prepare(painting, {.placement = {.zero_parallax_px = nearest_disparity(painting)}});
}

constexpr std::size_t most_bytes = std::size_t{1} << 26;
constexpr std::string_view head_header = "trial\ttime\tx\tdistance\tobserver\n";

bool is_digit(const std::string& name) { return name.size() == 1 && name[0] >= '0' && name[0] <= '9'; }

/// "1 … 5", with what its ends mean.
std::string scale_text(int least, int most, const std::string& least_means, const std::string& most_means) {
  const auto end = [](int number, const std::string& means) {
    return means.empty() ? fmt::format("{}", number) : fmt::format("{} ({})", number, means);
  };
  return fmt::format("{} … {}", end(least, least_means), end(most, most_means));
}

/// What is to be done, the question, and the keys that answer it.
std::string instruction_text(const StudyDesign& design) {
  const StudyTexts& texts = design.texts;
  const std::string keys = design.task == StudyTask::path ? fmt::format("Y: {}      N: {}", texts.yes, texts.no)
                                                          : scale_text(design.scale_least, design.scale_most, "", "");
  return fmt::format("{}\n\n{}\n{}", texts.instruction, texts.question, keys);
}

/// A picture in the middle of a grey one of the screen's size, reduced to whole shares where it is too large.
Image<Rgb8> in_the_middle(const Image<Rgb8>& picture, const StudyScreen& screen) {
  const int by = std::max({1, (picture.width() + screen.width_px - 1) / screen.width_px,
                           (picture.height() + screen.height_px - 1) / screen.height_px});
  const int width = picture.width() / by, height = picture.height() / by;
  Image<Rgb8> framed(screen.width_px, screen.height_px, {64, 64, 64});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      framed((screen.width_px - width) / 2 + x, (screen.height_px - height) / 2 + y) = picture(x * by, y * by);
  return framed;
}

}  // namespace

bool StudyScene::is_named(const std::filesystem::path& path) {
  return path.extension() == ".wst" || path.extension() == ".exr";
}

StudyScene::StudyScene(const std::filesystem::path& path) : scene_(read_scene(path)) {}

Image<Rgb8> StudyScene::draw(ViewPosition view) const {
  if (const auto* const painting = std::get_if<PreparedPainting>(&scene_))
    return wheatstone::draw(*painting, view).picture;
  const auto& slices = std::get<SliceStack>(scene_);
  return std::move(
      render_slices(slices, {.width = slices.width, .height = slices.height, .positions = {view}}).front());
}

StudyRunner::StudyRunner(const StudyFolder& folder, int subject, const StudyScreen& screen)
    : folder_(folder), screen_(screen), head_{0, screen.viewing_distance_mm} {
  const StudyDesign& design = folder.design();
  check_subject(design, subject);
  conditions_ = conditions_of_group(design, group_of_subject(design, subject));
  trials_ = plan_trials(design, subject);
  folder.make_stimuli(screen);
  if (design.items.empty())
    for (const PlannedTrial& trial : trials_) graph_of(trial);
  folder.add_participant(subject);
  log_ = std::make_unique<TrialLog>(folder.trial_table(subject), trial_table_header(design));
  head_log_ = std::make_unique<TrialLog>(folder.head_path(subject), head_header);
  records_ = read_subject(folder, subject);
  check_answered();
  // Questions are asked from the first one without an answer on.
  for (std::size_t i = 0; i < records_.answers.size(); ++i)
    if (records_.answers[i].first != design.questions[i].name) records_.answers.resize(i);
  if (records_.trials.empty()) return;
  // Practice is over, and these trials are done.
  next_ = std::min(trials_.size(), static_cast<std::size_t>(design.practice) + records_.trials.size());
  question_ = std::min(records_.answers.size(), design.questions.size());
  if (next_ == trials_.size() && question_ == design.questions.size()) page_ = Page::end;
}

void StudyRunner::check_answered() const {
  const auto first = static_cast<std::size_t>(folder_.design().practice);
  for (std::size_t i = 0; i < records_.trials.size(); ++i) {
    const TrialRecord& record = records_.trials[i];
    const PlannedTrial& plan = trials_[first + i];
    if (record.trial != static_cast<int>(i) + 1 || record.condition != plan.condition || record.item != plan.item)
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}:{}: is not the subject's trial {}, expected all trials from 1 on as they were shown",
                              folder_.trial_table(records_.number).string(), i + 2, i + 1));
  }
}

std::string StudyRunner::beginning() const {
  if (records_.trials.empty() || page_ == Page::end) return progress();
  const std::string subject = "sub-" + subject_label(folder_.design(), records_.number);
  const int all = static_cast<int>(trials_.size()) - folder_.design().practice;
  if (next_ < trials_.size()) return fmt::format("{}: goes on with trial {} of {}", subject, counted() + 1, all);
  if (question_ == folder_.design().questions.size()) return progress();
  return fmt::format("{}: goes on with question {} of {}", subject, question_ + 1, folder_.design().questions.size());
}

std::string StudyRunner::text() const {
  const StudyDesign& design = folder_.design();
  switch (page_) {
    case Page::instruction:
      return instruction_text(design);
    case Page::practice_ends:
      return design.texts.practice_ends;
    case Page::pause:
      return design.texts.pause;
    case Page::question: {
      const StudyQuestion& question = design.questions[question_];
      return question.text + "\n\n" +
             scale_text(question.least, question.most, question.least_means, question.most_means);
    }
    case Page::thanks:
      return design.texts.thanks;
    default:
      return {};
  }
}

int StudyRunner::counted() const { return std::max(0, static_cast<int>(next_) - folder_.design().practice); }

std::string StudyRunner::progress() const {
  const std::string subject = "sub-" + subject_label(folder_.design(), records_.number);
  const int all = static_cast<int>(trials_.size()) - folder_.design().practice;
  if (page_ == Page::end) return fmt::format("{}: finished", subject);
  if (next_ < trials_.size() && planned().practice) return fmt::format("{}: practice", subject);
  return fmt::format("{}: {} of {} trials done", subject, counted(), all);
}

std::vector<std::filesystem::path> StudyRunner::stimulus(const PlannedTrial& trial) const {
  std::vector<std::filesystem::path> paths;
  const StudyCondition& condition = conditions_[static_cast<std::size_t>(trial.condition)];
  for (const std::string& file : stimulus_files(folder_.design(), trial.item, condition))
    paths.push_back(folder_.stimuli() / file);
  return paths;
}

PathGraph StudyRunner::graph_of(const PlannedTrial& trial) const {
  const std::string file = stimulus(trial).front().string();
  PathGraph graph = graph_from_json(read_whole_file(file, most_bytes), file);
  if (const bool expected = is_connected(folder_.design(), trial.item); graph.connected != expected)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: connected: is {}, expected {} as the design has it", file, graph.connected, expected));
  return graph;
}

const StudyScene& StudyRunner::scene(const std::filesystem::path& path) {
  if (scene_path_ != path) {
    scene_.emplace(path);
    scene_path_ = path;
  }
  return *scene_;
}

StereoPair StudyRunner::draw() {
  const SimulatedDisplay& display = condition().shown.display;
  if (folder_.design().items.empty()) return draw_for_eyes(graph_of(planned()), screen_, display, head_);
  const std::vector<std::filesystem::path> paths = stimulus(planned());
  if (StudyScene::is_named(paths[0])) {
    const StudyScene& shown = scene(paths[0]);
    const auto draw_eye = [&](const EyePlace& eye) {
      return in_the_middle(shown.draw(ViewPosition(eye.x_mm / screen_.eye_separation_mm)), screen_);
    };
    return draw_for_eyes(draw_eye, screen_, display, head_);
  }
  const Image<Rgb8> left = read_image(paths[0]);
  if (paths.size() < 2 || display.monoscopic) return {in_the_middle(left, screen_), in_the_middle(left, screen_)};
  const Image<Rgb8> right = read_image(paths[1]);
  check_same_size(paths[1].string() + ": the picture", right, "the left eye's", left);
  return {in_the_middle(left, screen_), in_the_middle(right, screen_)};
}

bool StudyRunner::views_changed() {
  if (page_ != Page::trial) return false;
  if (!folder_.design().items.empty() && !StudyScene::is_named(stimulus(planned()).front())) return false;
  const auto shown = shown_views(condition().shown.display, screen_, head_);
  const bool changed = shown[0].view != seen_[0].view || shown[1].view != seen_[1].view;
  seen_ = shown;
  return changed;
}

void StudyRunner::shown(double time_s) {
  if (shown_s_) return;
  shown_s_ = time_s;
  head_at(head_, time_s);
}

void StudyRunner::head_at(const HeadPlace& head, double time_s) {
  head_ = head;
  if (page_ != Page::trial || !shown_s_) return;
  const double x_m = static_cast<double>(head.x_mm) / 1000;
  now_.head_least_m = std::isnan(now_.head_least_m) ? x_m : std::min(now_.head_least_m, x_m);
  now_.head_most_m = std::isnan(now_.head_most_m) ? x_m : std::max(now_.head_most_m, x_m);
  if (!planned().practice)
    head_path_ += fmt::format("{}\t{:.6f}\t{:.4f}\t{:.4f}\tperson\n", counted() + 1, time_s - *shown_s_, x_m,
                              head.distance_mm / 1000);
}

bool StudyRunner::key(const std::string& name, double pressed_s, double noted_s) {
  // What was pressed before the page was seen does not answer it.
  if (!shown_s_ || pressed_s < *shown_s_) return false;
  if (page_ == Page::trial) return answer_trial(name, pressed_s, noted_s);
  if (page_ == Page::question) return answer_question(name);
  if (name != "space") return false;
  if (page_ == Page::thanks) {
    page_ = Page::end;
  } else if (page_ != Page::end) {
    if (next_ < trials_.size())
      begin_trial();
    else
      go_to_question_or_end();
  }
  return true;
}

bool StudyRunner::answer_trial(const std::string& name, double pressed_s, double noted_s) {
  const StudyDesign& design = folder_.design();
  if (design.task == StudyTask::path) {
    if (name != "y" && name != "n") return false;
    record(name == "y" ? 1 : 0, pressed_s, noted_s);
  } else {
    if (!is_digit(name) || name[0] - '0' < design.scale_least || name[0] - '0' > design.scale_most) return false;
    record(name[0] - '0', pressed_s, noted_s);
  }
  ++next_;
  go_to_trial_or_on();
  return true;
}

void StudyRunner::record(int response, double pressed_s, double noted_s) {
  if (planned().practice) return;
  now_.trial = counted() + 1;
  now_.condition = planned().condition;
  now_.item = planned().item;
  now_.response = response;
  now_.response_time_s = pressed_s - *shown_s_;
  now_.log_delay_s = noted_s - pressed_s;
  log_->append(trial_table_row(folder_.design(), records_.number, now_, folder_.simulated()));
  records_.trials.push_back(now_);
  if (!head_path_.empty()) head_log_->append(head_path_);
}

void StudyRunner::go_to_trial_or_on() {
  const int pause_every = folder_.design().break_every;
  shown_s_.reset();
  if (next_ == trials_.size())
    go_to_question_or_end();
  else if (!planned().practice && trials_[next_ - 1].practice)
    page_ = Page::practice_ends;
  else if (!planned().practice && pause_every > 0 && counted() % pause_every == 0)
    page_ = Page::pause;
  else
    begin_trial();
}

void StudyRunner::begin_trial() {
  page_ = Page::trial;
  shown_s_.reset();
  now_ = {};
  head_path_.clear();
  seen_ = {};
}

void StudyRunner::go_to_question_or_end() {
  shown_s_.reset();
  const bool asks = question_ < folder_.design().questions.size();
  page_ = asks ? Page::question : Page::thanks;
  if (asks) return;
  log_->finish();
  head_log_->finish();
}

bool StudyRunner::answer_question(const std::string& name) {
  const StudyQuestion& question = folder_.design().questions[question_];
  if (!is_digit(name) || name[0] - '0' < question.least || name[0] - '0' > question.most) return false;
  records_.answers.emplace_back(question.name, name[0] - '0');
  folder_.write_answers(records_);
  ++question_;
  go_to_question_or_end();
  return true;
}

}  // namespace wheatstone::viewer
