#include "control_link.h"

#include <utility>

namespace wheatstone::viewer {
namespace {

constexpr int step_ms = 3;

}  // namespace

ControlLink::ControlLink(std::unique_ptr<Control> control, Viewer& viewer, std::function<void()> refresh)
    : control_(std::move(control)),
      viewer_(viewer),
      refresh_(std::move(refresh)),
      notifier_(control_->descriptor(), QSocketNotifier::Read) {
  timer_.setSingleShot(true);
  connect(&notifier_, &QSocketNotifier::activated, this, [this] { go_on(); });
  connect(&timer_, &QTimer::timeout, this, [this] { go_on(); });
}

void ControlLink::go_on() {
  // A dialog's own event loop, in which this is called again, may lie below.
  const bool is_nested = !notifier_.isEnabled();
  if (is_nested) return;
  notifier_.setEnabled(false);
  control_->go_on(viewer_);
  refresh_();
  notifier_.setEnabled(true);
  if (control_->is_waiting()) timer_.start(step_ms);
}

}  // namespace wheatstone::viewer
