#pragma once

#include <QObject>
#include <QSocketNotifier>
#include <functional>

namespace wheatstone::viewer {

/// SIGINT and SIGTERM, told in the event loop. One at a time.
class EndSignals final : public QObject {
 public:
  explicit EndSignals(std::function<void()> told);
  ~EndSignals() override;

 private:
  QSocketNotifier notifier_;
};

}  // namespace wheatstone::viewer
