#include "wheatstone/synthetic/synthetic_universe.h"

#include <fftw3.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "wheatstone/error.h"
#include "wheatstone/particles/cosmology.h"
#include "wheatstone/particles/write_gadget.h"
#include "wheatstone/random.h"

namespace wheatstone {
namespace {

using Grid = std::vector<float>;  // [x][y][z]
using Waves = std::vector<std::complex<float>>;
constexpr std::uint64_t noise = 1, jitter = 2, heat = 3;  // what a random number is for

float normal(std::uint64_t a) {
  const float radius = std::sqrt(-2 * std::log(1 - unit_float(a)));
  return radius * std::cos(2 * std::numbers::pi_v<float> * unit_float(a << 24));
}

struct Lattice {
  int side;    // cells
  double box;  // Mpc/h
  double wave(int i) const { return 2 * std::numbers::pi / box * (i <= side / 2 ? i : i - side); }
  std::size_t cells() const { return static_cast<std::size_t>(side) * side * side; }
  std::size_t waves() const { return static_cast<std::size_t>(side) * side * (side / 2 + 1); }
};

/// How high waves of wave number k stand at a redshift, as a multiple of today's. Smoothed by less than the nonlinear
/// scale, filaments are sharper, and few particles have passed through each other yet.
std::function<double(double k)> grown_waves(double redshift) {
  return [smoothing = nonlinear_scale(redshift), grown = growth(redshift)](double k) {
    return grown * std::exp(-k * k * smoothing * smoothing / 4);
  };
}

/// How fast they grow: in a unit of the scale factor.
std::function<double(double k)> growing_waves(double redshift) {
  const double scale = 1 / (1 + redshift), step = 1e-3 * scale;
  return [later = grown_waves(1 / (scale + step) - 1), earlier = grown_waves(1 / (scale - step) - 1), step](double k) {
    return (later(k) - earlier(k)) / (2 * step);
  };
}

/// White noise as waves.
Waves noise_waves(const Lattice& lattice, std::uint64_t seed) {
  const int side = lattice.side;
  Grid field(lattice.cells());
  tbb::parallel_for(std::size_t{0}, field.size(), [&](std::size_t i) {
    field[i] = normal(hash_keys({seed, noise, i}));
  });
  Waves waves(lattice.waves());
  const fftwf_plan plan = fftwf_plan_dft_r2c_3d(side, side, side, field.data(),
                                                reinterpret_cast<fftwf_complex*>(waves.data()), FFTW_ESTIMATE);
  fftwf_execute(plan);
  fftwf_destroy_plan(plan);
  return waves;
}

/// White noise, coloured by the spectrum: density as waves, each as high as `height` has it.
Waves density_waves(const Lattice& lattice, Waves waves, const std::function<double(double k)>& height) {
  const int side = lattice.side;
  const double cells = static_cast<double>(lattice.cells());
  const double volume = std::pow(lattice.box, 3);
  tbb::parallel_for(0, side, [&](int x) {
    for (int y = 0; y < side; ++y)
      for (int z = 0; z <= side / 2; ++z) {
        const double k = std::hypot(lattice.wave(x), lattice.wave(y), lattice.wave(z));
        // White noise has a power of one cell's volume.
        const double factor = height(k) * std::sqrt(cdm_power(k) * cells / volume) / cells;
        waves[(static_cast<std::size_t>(x) * side + y) * (side / 2 + 1) + z] *= static_cast<float>(factor);
      }
  });
  return waves;
}

/// One component of the displacement, in Mpc/h: i·k/k² times the density (Zel'dovich 1970).
Grid displacement(const Lattice& lattice, const Waves& density, int axis) {
  const int side = lattice.side;
  Waves waves(density.size());
  tbb::parallel_for(0, side, [&](int x) {
    for (int y = 0; y < side; ++y)
      for (int z = 0; z <= side / 2; ++z) {
        const std::array<double, 3> k{lattice.wave(x), lattice.wave(y), lattice.wave(z)};
        const double square = k[0] * k[0] + k[1] * k[1] + k[2] * k[2];
        const std::size_t i = (static_cast<std::size_t>(x) * side + y) * (side / 2 + 1) + z;
        if (square > 0) waves[i] = density[i] * std::complex<float>(0, static_cast<float>(k[axis] / square));
      }
  });
  Grid field(lattice.cells());
  const fftwf_plan plan = fftwf_plan_dft_c2r_3d(side, side, side, reinterpret_cast<fftwf_complex*>(waves.data()),
                                                field.data(), FFTW_ESTIMATE);
  fftwf_execute(plan);
  fftwf_destroy_plan(plan);
  return field;
}

/// All three, in cells.
std::array<Grid, 3> displacements(const Lattice& lattice, const Waves& density, const Progress& progress) {
  std::array<Grid, 3> grids;
  const auto cells_a_mpc = static_cast<float>(lattice.side / lattice.box);
  for (int axis = 0; axis < 3; ++axis) {
    report(progress, "field", (axis + 1) / 5.);
    grids[axis] = displacement(lattice, density, axis);
    for (float& value : grids[axis]) value *= cells_a_mpc;
  }
  return grids;
}

/// The eight cells around a point of a periodic grid, and how much of each.
struct Corners {
  std::array<std::size_t, 8> cell;
  std::array<float, 8> share;
};

Corners corners(const std::array<float, 3>& at, int side) {
  std::array<std::array<int, 2>, 3> index{};
  std::array<std::array<float, 2>, 3> share{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float below = std::floor(at[axis]);
    const int first = static_cast<int>(below) & (side - 1);  // the side is a power of two
    index[axis] = {first, (first + 1) & (side - 1)};
    share[axis] = {1 - (at[axis] - below), at[axis] - below};
  }
  Corners found{};
  for (std::size_t i = 0; i < 8; ++i) {
    const std::size_t x = i >> 2;
    const std::size_t y = i >> 1 & 1;
    const std::size_t z = i & 1;
    found.cell[i] = (static_cast<std::size_t>(index[0][x]) * side + index[1][y]) * side + index[2][z];
    found.share[i] = share[0][x] * share[1][y] * share[2][z];
  }
  return found;
}

float sample(const Grid& grid, const Corners& at) {
  float sum = 0;
  for (std::size_t i = 0; i < 8; ++i) sum += at.share[i] * grid[at.cell[i]];
  return sum;
}

/// Kelvin: warm where nothing happened, and heated by shocks where gas has fallen together.
float temperature_of(float density, std::uint64_t key) {
  const float quiet = 1e4f * std::pow(density, 0.6f);
  const float shocked = 2e6f * std::pow(density / 30, 1.3f) / (1 + std::pow(density / 400, 0.8f));
  const float scatter = std::exp(0.35f * normal(key));
  return std::clamp((quiet + shocked) * scatter, 1e2f, 2e8f);
}

}  // namespace

struct SyntheticUniverse::State {
  SyntheticUniverseOptions options;
  Lattice field;
  std::array<Grid, 3> displaced;  // in cells
  std::array<Grid, 3> rate;       // in cells in a unit of the scale factor; empty without motion
  Grid density;                   // in units of the mean
  std::uint64_t lattice_side = 0;
  std::uint64_t made = 0;

  std::array<float, 3> undisplaced(std::uint64_t particle) const;
  void put_motion(std::uint64_t particle, const Corners& here, std::size_t row, Cloud& cloud) const;
  void sum_density();
};

/// Where a particle begins, in cells of the field: its place on the lattice, shaken a little.
std::array<float, 3> SyntheticUniverse::State::undisplaced(std::uint64_t particle) const {
  const std::uint64_t side = lattice_side;
  const std::uint64_t cells = side * side * side;
  // Where the count is no cube, some places are left empty, evenly.
  const auto cell = static_cast<std::uint64_t>(static_cast<long double>(particle) * cells / options.particles);
  const float scale = static_cast<float>(field.side) / static_cast<float>(side);
  std::array<float, 3> at{};
  const std::array<std::uint64_t, 3> index{cell / (side * side), cell / side % side, cell % side};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float shaken = 0.5f + 0.8f * (unit_float(hash_keys({options.seed, jitter, particle, axis})) - 0.5f);
    at[axis] = (static_cast<float>(index[axis]) + shaken) * scale;
  }
  return at;
}

void SyntheticUniverse::State::put_motion(std::uint64_t particle, const Corners& here, std::size_t row,
                                          Cloud& cloud) const {
  const auto a_cell = static_cast<float>(1000 * options.box_mpc_h / field.side);
  cloud.id[row] = particle + 1;
  cloud.rate_x[row] = sample(rate[0], here) * a_cell;
  cloud.rate_y[row] = sample(rate[1], here) * a_cell;
  cloud.rate_z[row] = sample(rate[2], here) * a_cell;
}

/// Moves one point from every half cell's width and adds it to the cells around it.
void SyntheticUniverse::State::sum_density() {
  density.assign(field.cells(), 0.f);
  for (int x = 0; x < field.side; ++x)
    for (int y = 0; y < field.side; ++y)
      for (int z = 0; z < field.side; ++z) {
        const std::size_t cell = (static_cast<std::size_t>(x) * field.side + y) * field.side + z;
        const Corners around =
            corners({static_cast<float>(x) + displaced[0][cell], static_cast<float>(y) + displaced[1][cell],
                     static_cast<float>(z) + displaced[2][cell]},
                    field.side);
        for (std::size_t i = 0; i < 8; ++i) density[around.cell[i]] += around.share[i];
      }
}

SyntheticUniverse::SyntheticUniverse(const SyntheticUniverseOptions& options, const Progress& progress)
    : state_(std::make_unique<State>()) {
  if (options.particles == 0) throw Error(ErrorKind::wrong_usage, "the number of particles is 0, expected at least 1");
  if (!(options.redshift >= 0 && options.redshift <= 1000))
    throw Error(ErrorKind::wrong_usage, fmt::format("the redshift is {}, expected 0 to 1000", options.redshift));
  if (!(options.box_mpc_h >= 1 && options.box_mpc_h <= 10000))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("the side of the box is {} Mpc/h, expected 1 to 10000", options.box_mpc_h));
  State& state = *state_;
  state.options = options;
  state.lattice_side = static_cast<std::uint64_t>(std::ceil(std::cbrt(static_cast<double>(options.particles)) - 1e-9));
  const auto side = std::bit_ceil(std::clamp<std::uint64_t>(state.lattice_side, 32, 256));
  state.field = {static_cast<int>(side), options.box_mpc_h};

  report(progress, "field", 0);
  const Waves white = noise_waves(state.field, options.seed);
  const auto moved_by = [&](const std::function<double(double k)>& height) {
    return displacements(state.field, density_waves(state.field, white, height), progress);
  };
  state.displaced = moved_by(grown_waves(options.redshift));
  if (options.motion) state.rate = moved_by(growing_waves(options.redshift));
  report(progress, "field", 0.8);
  state.sum_density();
  report(progress, "field", 1);
}

SyntheticUniverse::~SyntheticUniverse() = default;
SyntheticUniverse::SyntheticUniverse(SyntheticUniverse&&) noexcept = default;
SyntheticUniverse& SyntheticUniverse::operator=(SyntheticUniverse&&) noexcept = default;

double SyntheticUniverse::box_size() const { return 1000 * state_->options.box_mpc_h; }

double SyntheticUniverse::mass_of_a_particle() const {
  // The critical density is 27.7536627 × 1e10 Msun/h a (Mpc/h)³.
  return 27.7536627 * matter_share * std::pow(state_->options.box_mpc_h, 3) /
         static_cast<double>(state_->options.particles);
}

Cloud SyntheticUniverse::next(std::size_t most) {
  State& state = *state_;
  const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(most, state.options.particles - state.made));
  Cloud cloud;
  cloud.box_size = box_size();
  for (std::vector<float>* column :
       {&cloud.x, &cloud.y, &cloud.z, &cloud.density, &cloud.temperature, &cloud.smoothing_length})
    column->resize(count);
  if (state.options.motion) {
    cloud.id.resize(count);
    for (std::vector<float>* rate : {&cloud.rate_x, &cloud.rate_y, &cloud.rate_z}) rate->resize(count);
  }
  const auto box = static_cast<float>(box_size());
  const float a_cell = box / static_cast<float>(state.field.side);
  const double mass = mass_of_a_particle();
  const double mean_density = mass * static_cast<double>(state.options.particles) / std::pow(box_size(), 3);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const std::uint64_t particle = state.made + i;
      std::array<float, 3> at = state.undisplaced(particle);
      const Corners here = corners(at, state.field.side);
      if (state.options.motion) state.put_motion(particle, here, i, cloud);
      const std::array<std::vector<float>*, 3> axes{&cloud.x, &cloud.y, &cloud.z};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        at[axis] += sample(state.displaced[axis], here);
        const float position = at[axis] * a_cell;
        const float wrapped = position - box * std::floor(position / box);
        (*axes[axis])[i] = wrapped < box ? wrapped : 0;
      }
      const float density = std::max(sample(state.density, corners(at, state.field.side)), 0.02f);
      cloud.density[i] = density * static_cast<float>(mean_density);
      cloud.temperature[i] = temperature_of(density, hash_keys({state.options.seed, heat, particle}));
      // A ball that holds 32 neighbours.
      const double volume = 32 * mass / cloud.density[i];
      cloud.smoothing_length[i] = static_cast<float>(std::cbrt(volume * 3 / (4 * std::numbers::pi)));
    }
  });
  state.made += count;
  return cloud;
}

void write_synthetic_universe(const std::filesystem::path& file, const SyntheticUniverseOptions& options,
                              const Progress& progress) {
  SyntheticUniverse universe(options, progress);
  GadgetWriter writer(file, {.particles = options.particles,
                             .box_size = universe.box_size(),
                             .redshift = options.redshift,
                             .mass_of_a_particle = universe.mass_of_a_particle(),
                             .motion = options.motion});
  constexpr std::size_t chunk = 1'000'000;
  std::uint64_t written = 0;
  while (written < options.particles) {
    report(progress, "particles", static_cast<double>(written) / static_cast<double>(options.particles));
    const Cloud cloud = universe.next(chunk);
    writer.add(cloud);
    written += cloud.size();
  }
  writer.commit();
}

Cloud make_synthetic_universe(const SyntheticUniverseOptions& options, const Progress& progress) {
  return SyntheticUniverse(options, progress).next(static_cast<std::size_t>(options.particles));
}

}  // namespace wheatstone
