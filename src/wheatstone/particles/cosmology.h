#pragma once

namespace wheatstone {

constexpr double matter_share = 0.31;  // Ωm
constexpr double sigma_8 = 0.8;

/// Power of density waves of wave number k, in h/Mpc, today, in (Mpc/h)³: cold dark matter (Bardeen et al. 1986), with
/// as much of it as makes σ8.
double cdm_power(double k);

/// How far structure has grown at a redshift, 1 today (Carroll, Press & Turner 1992).
double growth(double redshift);

/// How fast the universe expands at a scale factor, 1 being today's: H(a)/H0, without curvature.
double expansion_rate(double scale);

/// The length, in Mpc/h, over which the field must be smoothed (a Gaussian's deviation) for its variance to be 1.
double nonlinear_scale(double redshift);

}  // namespace wheatstone
