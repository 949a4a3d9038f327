#pragma once

// A few frames of a synthetic film with their central views, for what paints films.

#include <vector>

#include "wheatstone/motion/central_flow.h"
#include "wheatstone/stereo/central_view.h"
#include "wheatstone/stereo/view.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone {

struct ShortFilm {
  std::vector<SyntheticFilmFrame> frames;
  std::vector<CentralView> centres;
  std::vector<FlowPair> flows;  ///< of the central views, of each frame but the first

  std::vector<View> scene(std::size_t i) const {
    return scene_from_centre(centres[i], frames[i].pictures, frames[i].geometry);
  }
  const FlowPair* flow_to(std::size_t i) const { return i == 0 ? nullptr : &flows[i - 1]; }
  FlowPair left_flow_to(std::size_t i) const { return {frames[i - 1].to_next, frames[i].to_previous}; }
};

/// The first frames of a film, without flow.
inline ShortFilm first_frames(const SyntheticFilmOptions& options, int count) {
  ShortFilm film;
  for (int i = 0; i < count; ++i) {
    film.frames.push_back(make_synthetic_film_frame(options, i));
    film.centres.push_back(make_central_view(film.frames.back().pictures, film.frames.back().geometry));
  }
  return film;
}

/// The same with the true flow of its central views.
inline ShortFilm film_with_true_flow(const SyntheticFilmOptions& options, int count) {
  ShortFilm film = first_frames(options, count);
  const auto moment = [&](std::size_t i) {
    return MovingMoment{film.frames[i].geometry.left_disparity, film.centres[i].disparity};
  };
  for (std::size_t i = 1; i < film.frames.size(); ++i)
    film.flows.push_back(central_flow(film.left_flow_to(i), moment(i - 1), moment(i)));
  return film;
}

/// The same with flow as it is estimated.
inline ShortFilm film_with_estimated_flow(const SyntheticFilmOptions& options, int count) {
  ShortFilm film = first_frames(options, count);
  for (std::size_t i = 1; i < film.centres.size(); ++i)
    film.flows.push_back(estimate_flow(film.centres[i - 1].picture, film.centres[i].picture));
  return film;
}

}  // namespace wheatstone
