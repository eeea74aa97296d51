#pragma once
// Study files: TOML that names a kind of study and a gear, and in the tables of the kind what is asked of it.
// What is common to all kinds stands here; what a kind adds is its own (kind.hpp) and lies in its folder.
//
//     kind = "optimize"
//     gear = "seed.toml"                          # relative to the study file
//     [override]                                  # any key of the gear, by its path
//     "contact.lobes" = 2
//     [[load_case]]                               # default: the gear's [load]
//     torque_nm = 7.0
//     …                                           # the tables of the kind
//     [limits]
//     failure_share = 0.1
//     [reduced]                                   # what --reduced changes: keys of this file or of the gear
//     "method.budget" = 20
//
// Every fault of a file is reported at once (FileError), with the same words as in gear files.

#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/gear_file/file_error.hpp"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace strainwave {

class StudyKind;
/// The kinds of study that a program knows, in the order in which they are listed; the first is the one that
/// a file without a legal kind is read as.
using StudyKinds = std::span<const StudyKind* const>;

/// Exactly one of torque and rotation is given.
struct LoadCase {
  std::optional<double> torque_nm;
  std::optional<double> rotation_rad;
  int phases = 1; ///< meshing positions over one pitch
  Direction direction = Direction::drive;
};

/// How every kind of study names a load: "load_case[2].torque_nm".
struct LoadKey {
  std::size_t number = 0;
  bool torque = true; ///< else rotation_rad
};
/// Nothing for other paths.
std::optional<LoadKey> load_key(std::string_view path);

/// Another number of the gear that moves with a variable: number at `path` = ratio · variable.
struct VariableLink {
  std::string path;
  double ratio = 1.0;
};

struct StudyLimits {
  double failure_share = 0.01; ///< of the evaluations that may fail
};

/// One line of [override] or [reduced].
struct StudyChange {
  std::string path;
  FieldValue value;
};

/// What the tables of one kind of study say; copied with its study.
struct StudyPart {
  StudyPart() = default;
  StudyPart(const StudyPart&) = default;
  StudyPart& operator=(const StudyPart&) = default;
  virtual ~StudyPart() = default;
  virtual std::unique_ptr<StudyPart> copy() const = 0;
};

/// Holds the part of a study as a value.
class OwnPart {
public:
  OwnPart() = default;
  explicit OwnPart(std::unique_ptr<StudyPart> part) : part_(std::move(part)) {}
  OwnPart(const OwnPart& other) : part_(other.part_ ? other.part_->copy() : nullptr) {}
  OwnPart(OwnPart&&) noexcept = default;
  OwnPart& operator=(OwnPart other) noexcept {
    part_ = std::move(other.part_);
    return *this;
  }
  StudyPart* get() const { return part_.get(); }

private:
  std::unique_ptr<StudyPart> part_;
};

struct StudyFile {
  std::string file;
  const StudyKind* kind = nullptr;
  std::string gear_file; ///< absolute
  int seed = 1;
  bool reduced = false;
  Gear gear; ///< the gear's file with [override] applied (and [reduced], if asked for): the baseline
  std::vector<LoadCase> load_cases; ///< never empty
  StudyLimits limits;
  std::vector<StudyChange> overrides; ///< already in `gear`
  std::vector<StudyChange>
      reduced_changes; ///< empty if `reduced`: they are applied, those of the gear to `overrides`
  OwnPart own;         ///< what the kind's tables say

  StudyFile() = default;
  /// A study of this kind with nothing in it yet.
  explicit StudyFile(const StudyKind& of_kind);

  /// The kind's part, by its type or a type that it derives from. Throws std::bad_cast for another kind's.
  template <class Part>
  const Part& part() const {
    return dynamic_cast<const Part&>(*own.get());
  }
  template <class Part>
  Part& part() {
    return dynamic_cast<Part&>(*own.get());
  }
  /// Null for a study without it.
  template <class Part>
  const Part* find_part() const {
    return dynamic_cast<const Part*>(own.get());
  }
};

/// Throws FileError (of the study file, or of the gear file that it names), std::system_error.
StudyFile load_study(const std::string& path, StudyKinds kinds, bool reduced = false);

/// `name` stands in messages; the gear file is looked for beside it.
StudyFile parse_study(std::string_view text, const std::string& name, StudyKinds kinds, bool reduced = false);

/// A study from what write_study() and write_gear(study.gear) have given: needs no other file, so that a
/// study's folder can be read on another machine. `name`: of the file that holds both, for messages.
StudyFile restore_study(std::string_view text, std::string_view gear_text, const std::string& name,
                        StudyKinds kinds);

/// Does this TOML text describe a study (and not a gear)? False for what is no TOML.
bool is_study_text(std::string_view text, StudyKinds kinds);

/// The study as a file with every default filled in; it reads back to the same study. What `reduced` changed
/// stays changed, so the printed file needs no --reduced.
std::string write_study(const StudyFile& study);

} // namespace strainwave
