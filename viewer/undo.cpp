#include "undo.h"

#include <utility>

namespace wheatstone::viewer {
namespace {

/// What can be undone of a state: not where one looks from.
ViewState parameters_of(ViewState state) {
  const ViewState as_new;
  state.framed = as_new.framed;
  state.head = as_new.head;
  state.orbit = as_new.orbit;
  state.share = as_new.share;
  state.step = as_new.step;
  state.comparison = as_new.comparison;
  state.layers_apart_deg = as_new.layers_apart_deg;
  state.depth_around = as_new.depth_around;
  return state;
}

void go_back(Viewer& viewer, std::vector<ViewState>& from, std::vector<ViewState>& to) {
  if (from.empty()) return;
  Session& session = viewer.session();
  const bool painted_anew = from.back().style != session.state.style;
  const ViewState now = session.state;
  session.state = from.back();
  session.state.framed = now.framed;
  session.state.head = now.head;
  session.state.orbit = now.orbit;
  session.state.share = now.share;
  session.state.comparison = now.comparison;
  session.state.layers_apart_deg = now.layers_apart_deg;
  session.state.depth_around = now.depth_around;
  to.push_back(now);
  from.pop_back();
  session.zero_parallax_target_px.reset();
  if (painted_anew) viewer.paint();
}

}  // namespace

void Change::keep(Session& session) const {
  const bool is_moving = session.zero_parallax_target_px && session.zero_parallax_target_px != target_before_;
  if (!is_moving && parameters_of(session.state) == parameters_of(before_)) return;
  constexpr std::size_t most_states = 200;
  if (session.done.size() == most_states) session.done.erase(session.done.begin());
  session.done.push_back(before_);
  session.undone.clear();
}

void undo(Viewer& viewer) { go_back(viewer, viewer.session().done, viewer.session().undone); }
void redo(Viewer& viewer) { go_back(viewer, viewer.session().undone, viewer.session().done); }

}  // namespace wheatstone::viewer
