#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "wheatstone/image/image.h"
#include "wheatstone/matching/match_features.h"
#include "wheatstone/progress.h"

namespace wheatstone {

/// A checkerboard as it is printed. What counts are the inner corners, at which four squares meet.
struct Checkerboard {
  int columns = 11;      ///< inner corners a row
  int rows = 7;          ///< rows of inner corners
  double square_mm = 1;  ///< side of a square
};

/// One position of the board, seen by both cameras of a rig. Corners go row by row, `columns × rows` of them, the same
/// corner at the same place in both lists; a list is empty where the board was not found.
struct BoardSighting {
  std::string left_name, right_name;  ///< for messages: the pictures' files
  int width = 0;                      ///< of either picture, in pixels
  int height = 0;
  std::vector<PicturePoint> left, right;
};

/// The inner corners of a board, to a fraction of a pixel; empty where it is not wholly visible. Throws
/// Error{wrong_usage} for fewer than 3 corners a side, squares without a size.
std::vector<PicturePoint> find_checkerboard(ImageView<const Rgb8> picture, const Checkerboard& board);

/// Finds the board in a pair. A board that looks the same when turned by half is numbered alike in both pictures.
/// Throws Error as find_checkerboard, and bad_input where the sizes of the pictures differ.
BoardSighting find_checkerboards(ImageView<const Rgb8> left, ImageView<const Rgb8> right, const Checkerboard& board);

/// The files of one position of the board.
struct PictureFiles {
  std::filesystem::path left, right;
};

/// Reads pictures and finds the board in each, one pair after the other. Throws Error as read_image and
/// find_checkerboards.
std::vector<BoardSighting> find_checkerboards(std::span<const PictureFiles> files, const Checkerboard& board,
                                              const Progress& progress = {});

}  // namespace wheatstone
