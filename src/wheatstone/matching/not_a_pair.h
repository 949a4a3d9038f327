#pragma once

#include "wheatstone/image/image.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// How much of two pictures of one size shows the same, moved mostly sideways, as two eyes see it.
struct BlockAgreement {
  int blocks = 0;    ///< that have enough texture to tell
  double share = 0;  ///< of those, 0..1: found in the other picture, found back from there, and moved as a neighbour is
};

/// Compares blocks of small copies by normalised correlation, up to a third of the width sideways and a few rows up and
/// down. Where a third of the rows shows that fewer than `least_share` of the blocks are found at all, the other rows
/// are not looked at, the share is 0, and `blocks` are those of the third.
BlockAgreement block_agreement(ImageView<const Rgb8> a, ImageView<const Rgb8> b, double least_share);

/// How well two pictures fit together as two views of one scene.
struct PairEvidence {
  int left_features = 0;  ///< SIFT, in copies of a sensible size
  int right_features = 0;
  int matches = 0;         ///< features that are clearly each other's
  int inliers = 0;         ///< of those, on one epipolar geometry (fundamental matrix, RANSAC)
  double block_share = 0;  ///< of textured blocks, 0..1: found where the other eye would see them
};

PairEvidence pair_evidence(const StereoPair& pair);

/// Whether the pictures show two different scenes: both have features enough, but hardly any of them fit together, nor
/// do their blocks. False where there is too little to go by. Rectification is not asked for.
bool not_a_pair(const StereoPair& pair);

}  // namespace wheatstone
