#include "film_bar.h"

#include <fmt/format.h>

#include <QLabel>
#include <QProgressBar>
#include <QSlider>
#include <QStyle>
#include <QToolButton>
#include <utility>

namespace wheatstone::viewer {
namespace {

constexpr int most_steps = 10'000;  ///< of the slider

std::string clock_text(double seconds) {
  const int whole = static_cast<int>(seconds);
  return fmt::format("{}:{:02}.{:02}", whole / 60, whole % 60, static_cast<int>(seconds * 100) % 100);
}

}  // namespace

FilmBar::FilmBar(QWidget* parent, std::function<void(const std::string&, const Words&)> run) : QToolBar(parent) {
  setObjectName("film");
  setWindowTitle("Film");
  setMovable(false);
  play_ = new QToolButton(this);
  play_->setAccessibleName("Play or pause");
  play_->setFocusPolicy(Qt::NoFocus);
  connect(play_, &QToolButton::clicked, this, [run] { run("play-or-pause", {}); });
  slider_ = new QSlider(Qt::Horizontal, this);
  slider_->setAccessibleName("Position in the film");
  slider_->setRange(0, most_steps);
  slider_->setFocusPolicy(Qt::NoFocus);  // the arrow keys are commands
  connect(slider_, &QSlider::sliderMoved, this, [this, run](int step) {
    run("seek-to", {fmt::format("{}", slider_->property("duration_s").toDouble() * step / most_steps)});
  });
  time_ = new QLabel(this);
  progress_ = new QProgressBar(this);
  progress_->setMaximumWidth(420);
  progress_->setAccessibleName("Painting the whole film");
  cancel_ = new QToolButton(this);
  cancel_->setText("Cancel");
  cancel_->setFocusPolicy(Qt::NoFocus);
  connect(cancel_, &QToolButton::clicked, this, [run = std::move(run)] { run("cancel", {}); });
  addWidget(play_);
  addWidget(slider_);
  addWidget(time_);
  progress_action_ = addWidget(progress_);
  cancel_action_ = addWidget(cancel_);
  hide();
}

void FilmBar::show_session(const Session& session) {
  setVisible(!session.full_screen && (session.film || session.whole_film));
  if (const auto& film = session.film) {
    play_->setIcon(style()->standardIcon(film->plays ? QStyle::SP_MediaPause : QStyle::SP_MediaPlay));
    slider_->setProperty("duration_s", film->duration_s);
    slider_->setEnabled(film->duration_s > 0);
    if (!slider_->isSliderDown() && film->duration_s > 0)
      slider_->setValue(static_cast<int>(most_steps * film->seconds / film->duration_s));
    const std::string moment = film->moment.empty() ? std::string() : film->moment + ", ";
    const std::size_t keys = session.camera_path.keys.size();
    const std::string path = film->of_particles && keys > 0 ? fmt::format(", {} keyframes", keys) : std::string();
    time_->setText(QString::fromStdString(fmt::format(" {}{} / {}, frame {}{} ", moment, clock_text(film->seconds),
                                                      clock_text(film->duration_s), film->frame, path)));
  }
  progress_action_->setVisible(session.whole_film.has_value());
  cancel_action_->setVisible(session.whole_film.has_value());
  if (!session.whole_film) return;
  progress_->setFormat(QString::fromStdString(session.whole_film->step));
  progress_->setValue(static_cast<int>(100 * session.whole_film->done));
}

}  // namespace wheatstone::viewer
