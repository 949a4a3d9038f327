#include "particle_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "wheatstone/app/snapshot_series.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone::viewer {

ParticleReader::ParticleReader(std::filesystem::path input) : input_(std::move(input)), first_(input_) {
  if (const std::optional<SnapshotSeries> series = find_series(input_.string())) {
    times_ = series->times;
    first_ = series->files.front();
  }
  const CloudSource source = open_cloud(first_);
  fields_ = source.fields;
  time_is_scale_factor_ = source.time && source.redshift && std::abs(*source.time * (1 + *source.redshift) - 1) < 1e-3;
}

std::shared_ptr<const Particles> ParticleReader::read(const std::string& quantity, double time,
                                                      const Progress& progress) {
  auto particles = std::make_shared<Particles>();
  const RenderParticlesOptions options{.quantity = quantity};
  const CloudSource source = open_cloud(first_, choice_of(options));
  if (times_.empty()) {
    static_cast<ReadyParticles&>(*particles) = read_particles(input_, options, progress);
    particles->redshift = source.redshift;
  } else {
    if (!frames_ || frames_quantity_ != quantity) {
      frames_.reset();
      frames_.emplace(input_.string(), ParticleFramesOptions{.particles = options, .count = 2, .path = {}}, progress);
      frames_quantity_ = quantity;
    }
    static_cast<ReadyParticles&>(*particles) = frames_->particles_at(time, progress);
    particles->time = time;
    if (time_is_scale_factor_) particles->redshift = 1 / time - 1;
  }
  particles->quantity = quantity_name_of(quantity);
  particles->units = units_of(source, options, particles->statistics.has_mass);
  return particles;
}

std::optional<std::filesystem::path> series_pattern_of(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  constexpr std::string_view digits = "0123456789";
  const std::string stem = file.stem().string();
  const std::size_t last = stem.find_last_of(digits);
  if (last == std::string::npos || name.find('%') != std::string::npos) return {};
  const std::size_t before = stem.find_last_not_of(digits, last);
  const std::size_t first = before == std::string::npos ? 0 : before + 1;
  const std::size_t count = last + 1 - first;
  const std::string number = count > 1 ? fmt::format("%0{}d", count) : "%d";
  std::filesystem::path path = file.parent_path() / (name.substr(0, first) + number + name.substr(last + 1));
  const std::optional<FramePattern> pattern = frame_pattern(path);
  if (!pattern || !pattern->number_of(name) || numbers_of(*pattern).size() < 2) return {};
  return path;
}

std::optional<std::filesystem::path> series_of_files(const std::vector<std::filesystem::path>& files) {
  if (files.size() < 2) return {};
  const std::optional<std::filesystem::path> pattern = series_pattern_of(files.front());
  if (!pattern || numbers_of(*frame_pattern(*pattern)).size() != files.size()) return {};
  const auto is_of_it = [&](const std::filesystem::path& file) { return series_pattern_of(file) == pattern; };
  return std::ranges::all_of(files, is_of_it) && holds_particles(files.front()) ? pattern : std::nullopt;
}

}  // namespace wheatstone::viewer
