#include "strainwave/model/export/figure.hpp"

#include "strainwave/common/files/whole_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

extern char** environ;

namespace strainwave {

namespace {

/// Two open sides, ticks outside, a faint grid behind the data.
std::string script(const Figure& figure) {
  return fmt::format(
      "# gnuplot {0}.gp draws {0}.svg from {0}.dat\n"
      "set terminal svg size {1},{2} enhanced font 'DejaVu Sans,Helvetica,Arial,sans-serif,13' "
      "background '#ffffff'\n"
      "set output '{0}.svg'\n"
      "set encoding utf8\n"
      "set border 3 linewidth 1 linecolor '#404040'\n"
      "set tics nomirror out scale 0.6 textcolor '#202020'\n"
      "set grid back linetype 1 linecolor '#e8e8e8' linewidth 0.8\n"
      "set key top right samplen 2 spacing 1.2 textcolor '#202020'\n"
      "set datafile missing 'nan'\n"
      "{3}",
      figure.name, figure.width, figure.height, figure.drawing);
}

/// Runs `gnuplot NAME.gp` in the folder; its wait status, or −errno when it cannot be started.
int run_gnuplot(const std::string& name, const std::filesystem::path& folder) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  std::string program = "gnuplot", argument = name + ".gp";
  std::array<char*, 3> arguments = {program.data(), argument.data(), nullptr};
  pid_t process = 0;
  const int error = posix_spawnp(&process, "gnuplot", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    return -error;
  int status = 0;
  while (waitpid(process, &status, 0) < 0)
    if (errno != EINTR)
      return -errno;
  return status;
}

} // namespace

std::string figure_colour(std::size_t index) {
  constexpr std::array<const char*, 6> palette = {"#0072B2", "#D55E00", "#009E73",
                                                  "#CC79A7", "#E69F00", "#56B4E9"};
  return palette[index % palette.size()];
}

Drawn draw(const std::vector<Figure>& figures, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const Figure& figure : figures) {
    write_whole_text(folder / (figure.name + ".dat"), figure.data);
    write_whole_text(folder / (figure.name + ".gp"), script(figure));
  }
  for (const Figure& figure : figures) {
    const int status = run_gnuplot(figure.name, folder);
    if (status == -ENOENT)
      return {false, fmt::format(
                         "gnuplot is not installed (package gnuplot-nox): {} holds the data and the scripts, "
                         "but no pictures",
                         folder.string())};
    if (status < 0)
      return {false, fmt::format("gnuplot could not be started: {}", std::strerror(-status))};
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
      return {false, fmt::format("gnuplot did not draw {}; run it there to see why",
                                 (folder / (figure.name + ".gp")).string())};
  }
  return {true, {}};
}

} // namespace strainwave
