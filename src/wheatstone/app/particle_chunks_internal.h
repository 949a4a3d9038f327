#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "wheatstone/app/render_particles.h"
#include "wheatstone/multiview/chunks.h"
#include "wheatstone/particles/cloud_statistics.h"
#include "wheatstone/particles/select.h"
#include "wheatstone/progress.h"

namespace wheatstone {

/// Columns that every cloud may have become the quantity without being read again. Throws Error{bad_input} where the
/// cloud has no such column.
void put_quantity(Cloud& cloud, const std::filesystem::path& file, const std::string& quantity);

/// Whether a file tells colours: such points lie on surfaces and need no density. Not so particles of several types.
bool has_colours_of_file(const Cloud& cloud, const RenderParticlesOptions& options);

/// Throws Error{bad_input} where a particle lies farther out than can be drawn.
void check_positions(const std::filesystem::path& file, const Cloud& cloud);

/// Says that nothing is left to draw, and why.
[[noreturn]] void refuse_nothing(const std::filesystem::path& file, const RenderParticlesOptions& options,
                                 const SelectionCounts& counts);

/// Particles of a file, of which all is known.
struct SurveyedParticles {
  CloudStatistics statistics;
  SelectionCounts counts;
  std::vector<Cloud> kept;  ///< all chunks that this rank has read, where they are few enough
  bool all_kept = true;
  DensitySource density = DensitySource::file;
};

/// Reads all particles once, together with the other ranks. Those of a small file stay in memory, so that they need not
/// be read again. Throws Error{bad_input}.
SurveyedParticles survey(const std::filesystem::path& file, const RenderParticlesOptions& options,
                         const Progress& progress);

/// The particles in chunks: those that were kept, or from the file again. What is given must stay.
Chunks chunks_from(const SurveyedParticles& surveyed, const std::filesystem::path& file,
                   const RenderParticlesOptions& options, const Progress& progress);

}  // namespace wheatstone
