#include "end_signals.h"

#include <QMetaObject>
#include <utility>

#include "cli/interrupt.h"

namespace wheatstone::viewer {

EndSignals::EndSignals(std::function<void()> told) : told_(std::move(told)) {
  cli::on_signal([this] {
    QMetaObject::invokeMethod(
        this, [this] { told_(); }, Qt::QueuedConnection);
  });
}

EndSignals::~EndSignals() { cli::on_signal({}); }

}  // namespace wheatstone::viewer
