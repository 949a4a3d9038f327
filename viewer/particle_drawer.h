#pragma once

#include <memory>
#include <vector>

#include "content.h"
#include "view_state.h"
#include "wheatstone/depth/rig.h"

namespace wheatstone::viewer {

/// How well something is drawn.
enum class Effort {
  quick,  ///< within a tenth of a second or so: for what moves
  whole,
};

struct DrawnParticles {
  std::vector<Image<Rgb8>> views;
  Brightness brightness;  ///< that all particles were given
  bool of_all = true;     ///< false: of a share of them, or not of the quantity that is to be shown
};

/// Draws views of particles: quickly, every nth particle with n times its light, or all of them. Keeps every nth
/// particle, and how long particles take. Of one thread.
class ParticleDrawer {
 public:
  /// Throws as render, and as particle_scene.
  DrawnParticles draw(const std::shared_ptr<const Particles>& particles, const ViewState& state, const Rig& rig,
                      Effort effort);
  /// What is taken of the machine until it is measured, with every drawing.
  void expect_seconds_a_particle(double seconds) { seconds_a_particle_ = seconds; }

 private:
  std::size_t share_for(std::size_t particles) const;
  const ReadyParticles& thinned(const std::shared_ptr<const Particles>& particles, std::size_t every);

  std::shared_ptr<const Particles> of_;
  std::size_t every_ = 1;
  ReadyParticles thinned_;
  double seconds_a_particle_ = 2e-7;
};

}  // namespace wheatstone::viewer
