#pragma once

#include <QObject>
#include <functional>

namespace wheatstone::viewer {

/// The signals that cli/interrupt.h watches, told in the event loop. One at a time.
class EndSignals final : public QObject {
 public:
  explicit EndSignals(std::function<void()> told);
  ~EndSignals() override;

 private:
  std::function<void()> told_;
};

}  // namespace wheatstone::viewer
