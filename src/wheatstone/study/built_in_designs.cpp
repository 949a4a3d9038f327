#include <array>

#include "wheatstone/study/study_design.h"

namespace wheatstone {
namespace {

constexpr std::string_view path_searching_1 = R"(# How many views, and how much depth, does path searching need?
# Hassaine 2010, section 3.2 (ACM Transactions on Applied Perception 8(1)): depth and density of views within subjects.
name = "path-searching-1"
title = "Path searching: depth and density of views"
task_label = "paths"
task = "path"
subjects = 39
repetitions = 6
order = "balanced"
arrangement = "rounds"
practice = 6
break_every = 20

[shown]
nodes = 90

[[factor]]
name = "depth_cm"
levels = [2, 10]

[[factor]]
name = "views_per_10cm"
levels = [0, 2, 4, 6, 8, 10]

[[control]]
name = "flat"
depth_cm = 0
views_per_10cm = 0

[texts]
instruction = """
You will see a network of balls and tubes. Two of the balls are red.
Being right matters more than being fast.
Move your head to the left and to the right as much as you like.
Press the space bar to begin."""
question = "Is there a path of exactly two tubes from one red ball to the other?"

[[question]]
name = "flipping"
text = "How much did you mind that the picture jumped when you moved?"
least_means = "not at all"
most_means = "very much"

[[question]]
name = "false_rotation"
text = "How much did you mind that the network turned with you?"
least_means = "not at all"
most_means = "very much"

[[question]]
name = "discomfort"
text = "How tired or uncomfortable are your eyes?"
least_means = "not at all"
most_means = "very"

[published.response_time]  # mean, standard deviation: table 3.1, whose heading calls the 10 cm of the text 5 cm
"depth_cm=2,views_per_10cm=0" = [18.94, 8.58]
"depth_cm=2,views_per_10cm=2" = [18.01, 8.32]
"depth_cm=2,views_per_10cm=4" = [17.80, 9.09]
"depth_cm=2,views_per_10cm=6" = [18.27, 8.21]
"depth_cm=2,views_per_10cm=8" = [18.47, 7.57]
"depth_cm=2,views_per_10cm=10" = [18.30, 6.48]
"depth_cm=10,views_per_10cm=0" = [18.22, 7.45]
"depth_cm=10,views_per_10cm=2" = [17.95, 7.81]
"depth_cm=10,views_per_10cm=4" = [17.07, 7.70]
"depth_cm=10,views_per_10cm=6" = [16.15, 5.87]
"depth_cm=10,views_per_10cm=8" = [16.19, 6.84]
"depth_cm=10,views_per_10cm=10" = [16.77, 7.93]
flat = [19.58, 9.80]

[published.percent_correct]  # table 3.2, with the same heading
"depth_cm=2,views_per_10cm=0" = [86.75, 13.34]
"depth_cm=2,views_per_10cm=2" = [88.46, 12.77]
"depth_cm=2,views_per_10cm=4" = [88.46, 14.39]
"depth_cm=2,views_per_10cm=6" = [89.74, 12.46]
"depth_cm=2,views_per_10cm=8" = [90.60, 13.13]
"depth_cm=2,views_per_10cm=10" = [88.89, 13.96]
"depth_cm=10,views_per_10cm=0" = [89.74, 11.86]
"depth_cm=10,views_per_10cm=2" = [92.31, 10.71]
"depth_cm=10,views_per_10cm=4" = [92.31, 12.00]
"depth_cm=10,views_per_10cm=6" = [93.59, 11.22]
"depth_cm=10,views_per_10cm=8" = [94.87, 10.92]
"depth_cm=10,views_per_10cm=10" = [93.59, 13.03]
flat = [77.35, 17.31]
)";

constexpr std::string_view path_searching_2 = R"(# How many views does head motion need without stereoscopic depth?
# Hassaine 2010, section 3.3: both eyes see the left view; only the head's movement to the sides counts.
name = "path-searching-2"
title = "Path searching: density of views for one eye's picture"
task_label = "paths"
task = "path"
subjects = 15
repetitions = 20
order = "balanced"
arrangement = "rounds"
practice = 6
break_every = 20

[shown]
nodes = 90
depth_cm = 10
monoscopic = true
track_distance = false

[[factor]]
name = "views_per_10cm"
levels = [2, 4, 6, 8, 50]

[texts]
instruction = """
You will see a network of balls and tubes. Two of the balls are red.
Being right matters more than being fast.
Move your head to the left and to the right: it helps.
Press the space bar to begin."""
question = "Is there a path of exactly two tubes from one red ball to the other?"

[[question]]
name = "flipping"
text = "How much did you mind that the picture jumped when you moved?"
least_means = "not at all"
most_means = "very much"

[[question]]
name = "discomfort"
text = "How tired or uncomfortable are your eyes?"
least_means = "not at all"
most_means = "very"

[published.response_time]  # mean, standard deviation: table 3.3
"views_per_10cm=2" = [19.49, 3.69]
"views_per_10cm=4" = [16.70, 6.08]
"views_per_10cm=6" = [17.44, 7.08]
"views_per_10cm=8" = [15.22, 5.03]
"views_per_10cm=50" = [16.42, 5.52]

[published.percent_correct]  # table 3.4
"views_per_10cm=2" = [87.67, 14.00]
"views_per_10cm=4" = [87.67, 10.83]
"views_per_10cm=6" = [88.33, 12.20]
"views_per_10cm=8" = [90.33, 9.72]
"views_per_10cm=50" = [91.00, 11.37]
)";

constexpr std::string_view painting_comfort = R"(# How comfortable are stereoscopic paintings to look at?
# Bukenberger et al. 2015, section 5: original, consistent and inconsistent versions of stereo pictures, rated from
# 1 (sick) to 5 (super). Each subject rates 12 of 20 pictures, each in one version.
name = "painting-comfort"
title = "Comfort of stereoscopic paintings"
task_label = "comfort"
task = "rating"
subjects = 30
repetitions = 4
order = "balanced"
arrangement = "rounds"
practice = 3
break_every = 20

[[factor]]
name = "version"
levels = ["original", "consistent", "inconsistent"]

[pictures]
items = ["01", "02", "03", "04", "05", "06", "07", "08", "09", "10",
         "11", "12", "13", "14", "15", "16", "17", "18", "19", "20"]
left = "{item}_{version}_left.png"
right = "{item}_{version}_right.png"
scale_least = 1
scale_most = 5

[texts]
instruction = """
You will see pictures in depth. Look at each as long as you like.
Press the space bar to begin."""
question = "How comfortable is this picture to look at, from 1 (sick) to 5 (super)?"

[published.rating]  # mean, standard deviation
"version=original" = [4.55, 0.66]
"version=consistent" = [3.71, 0.95]
"version=inconsistent" = [2.10, 0.93]
)";

constexpr std::string_view two_or_forty_five =
    R"(# Is a display of 45 views better than two eyes' views for reading graphs, and does that depend on their size?
# Two fixed views against a light-field display of 45 views over 40 degrees, seen from 70 cm: a view every 11.3 mm.
# Graphs as in Ware & Franck 1996: anywhere in a volume.
name = "two-or-forty-five"
title = "Two eyes or forty-five views, at three sizes of graphs"
task_label = "paths"
task = "path"
subjects = 24
repetitions = 12
order = "williams"
arrangement = "blocks"
practice = 6
break_every = 20

[shown]
placement = "volume"
depth_cm = 10

[[factor]]
name = "views"
levels = [{ name = "2", views_per_10cm = 0 }, { name = "45", views_per_10cm = 8.83, quantised = "eyes" }]

[[factor]]
name = "nodes"
levels = [60, 120, 240]

[texts]
instruction = """
You will see a network of balls and tubes. Two of the balls are red.
Being right matters more than being fast.
Move your head to the left and to the right as much as you like.
Press the space bar to begin."""
question = "Is there a path of exactly two tubes from one red ball to the other?"

[[question]]
name = "discomfort"
text = "How tired or uncomfortable are your eyes?"
least_means = "not at all"
most_means = "very"
)";

}  // namespace

std::span<const BuiltInDesign> built_in_designs() {
  static constexpr std::array<BuiltInDesign, 4> designs{{{"path-searching-1", path_searching_1},
                                                         {"path-searching-2", path_searching_2},
                                                         {"painting-comfort", painting_comfort},
                                                         {"two-or-forty-five", two_or_forty_five}}};
  return designs;
}

}  // namespace wheatstone
