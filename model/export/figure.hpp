#pragma once
// Figures drawn by gnuplot. A figure is a data file (NAME.dat, numbers with units in its head) and a script
// (NAME.gp) that draws NAME.svg from it, all in one folder: whoever wants another look edits the script and
// runs `gnuplot NAME.gp` there.

#include <filesystem>
#include <string>
#include <vector>

namespace strainwave {

struct Figure {
  std::string name;
  std::string data;              ///< blocks apart by two empty lines (gnuplot's index)
  std::string drawing;           ///< gnuplot commands after the common style; the data file is 'NAME.dat'
  int width = 760, height = 440; ///< pixels
};

/// Okabe and Ito's palette (jfly.uni-koeln.de/color, 2008), told apart by colour-blind readers, in order of
/// use: blue, vermilion, bluish green, reddish purple, orange, sky blue. `index` may be any number.
std::string figure_colour(std::size_t index);

/// How the drawing went: gnuplot may be absent, or refuse. The data and scripts are written in any case.
struct Drawn {
  bool complete = false;
  std::string note; ///< why a figure is missing, one sentence
};

/// Writes and draws all figures. Creates the folder. Throws std::system_error when files cannot be written.
Drawn draw(const std::vector<Figure>& figures, const std::filesystem::path& folder);

} // namespace strainwave
