#include "strainwave/model/gear_file/toml_source.hpp"

#include "strainwave/common/core/nearest.hpp"
#include "strainwave/model/gear_file/syntax_sentence.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

namespace strainwave {

namespace {

namespace fs = std::filesystem;

/// "no such file; did you mean studies/gallery/seed.toml?"
std::string missing_file_sentence(const fs::path& path, std::string_view kind) {
  std::vector<std::string> names;
  std::error_code ignored;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end && names.size() < 1000;
       entry.increment(ignored))
    names.push_back(entry->path().filename().string());
  const std::vector<std::string_view> views(names.begin(), names.end());
  const Nearest nearest = nearest_name(path.filename().string(), views);
  std::string sentence = fmt::format("no such {}", kind);
  if (nearest.close)
    sentence += fmt::format("; did you mean {}?", (path.parent_path() / nearest.name).string());
  else if (kind == "gear file")
    sentence += "; `strainwave example` prints one to start from";
  return sentence;
}

} // namespace

std::string read_text_file(const std::string& path, std::string_view kind) {
  constexpr std::size_t largest = 16u << 20;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found)
    throw FileError(path, {{{}, "", missing_file_sentence(path, kind), ""}});
  if (status.type() == fs::file_type::directory)
    throw FileError(path, {{{}, "", fmt::format("is a folder, not a {}", kind), ""}});
  const auto refused = [&path] {
    return std::system_error(errno ? errno : EIO, std::generic_category(), "cannot read " + path);
  };
  errno = 0;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file)
    throw refused();
  std::string text;
  char block[1 << 16];
  for (std::size_t count; (count = std::fread(block, 1, sizeof block, file.get())) > 0;) {
    text.append(block, count);
    if (text.size() > largest)
      throw FileError(path, {{{}, "", fmt::format("is larger than 16 MiB, so it is no {}", kind), ""}});
  }
  if (std::ferror(file.get()))
    throw refused();
  return text;
}

toml::table parse_toml(std::string_view text, const std::string& name) {
  try {
    return toml::parse(text, std::string_view(name));
  } catch (const toml::parse_error& error) {
    throw FileError(name, {syntax_fault(text, place_of(error.source()), error.description())});
  }
}

} // namespace strainwave
