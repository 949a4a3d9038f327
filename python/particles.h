#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "cli/render_arguments.h"
#include "wheatstone/app/render_particles.h"
#include "wheatstone/particles/cloud_source.h"

namespace wheatstone::python {

/// Particles of arrays, of a file, or between two files of a series.
struct PyParticles {
  Cloud cloud;
  std::string name;                      ///< what messages call them
  CloudSource source;                    ///< of what is told: format and units
  std::optional<double> redshift, time;  ///< as CloudSource has them
  bool is_file = false;
  CloudChoice choice;  ///< that a file was read with
};
using Particles = std::shared_ptr<const PyParticles>;

/// The options of a call, as `wheatstone render` has them.
using CallOptions = std::vector<cli::NamedWords>;

/// What a file tells, without what reads it.
CloudSource told_by(CloudSource source);

/// Particles of a file. Throws as read_cloud.
Particles read_particles_of(const std::filesystem::path& path, const CloudChoice& choice, const Progress& progress);

/// The libraries behind some formats are for one thread at a time: `work`, which reads files, has them alone. A process
/// is forked between two files, not within one: its child would never see the end.
void with_files(const std::function<void()>& work);

/// Views as an array, and what is told of them.
pybind11::tuple views_and_facts(RenderedParticles made);

/// Puts into the views what `annotate` asks for; what is left out becomes a warning.
void annotate_as_asked(const cli::RenderArguments& arguments, RenderedParticles& made);

void add_render(pybind11::module_& module);
void add_series(pybind11::module_& module);

}  // namespace wheatstone::python
