#pragma once

#include "command.h"

namespace wheatstone::cli {

// The commands of the program, each in its own file.
Command calibrate_command();
Command rectify_command();
Command match_command();
Command paint_command();
Command pack_command();
Command rotoscope_command();
Command render_command();
Command share_command();
Command depth_command();
Command measure_film_command();
Command measure_painting_command();
Command measure_stereo_command();
Command measure_views_command();
Command synth_film_command();
Command synth_model_command();
Command synth_still_command();
Command synth_universe_command();
Command study_analyse_command();
Command study_design_command();
Command study_run_command();
Command study_simulate_command();
Command study_stimuli_command();
Command view_command();
Command info_command();

}  // namespace wheatstone::cli
