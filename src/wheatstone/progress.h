#pragma once

#include <functional>
#include <string_view>

namespace wheatstone {

/// Told by a long call which step it is in and how much of it is done, 0..1. Called from one thread at a time, often
/// enough for a progress bar. What it throws ends the call: that is how a run is interrupted.
using Progress = std::function<void(std::string_view step, double done)>;

inline void report(const Progress& progress, std::string_view step, double done) {
  if (progress) progress(step, done);
}

}  // namespace wheatstone
