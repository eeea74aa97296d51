// Which exception means which end of the program.

#include "app/exit_codes.hpp"

#include "app/output.hpp"
#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/gear_file/file_error.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <new>
#include <system_error>

namespace strainwave::app {
namespace {

struct End {
  ExitCode code;
  std::string said;
};

template <class Exception>
End end_of(const Exception& exception) {
  testing::internal::CaptureStderr();
  const ExitCode code = run_guarded([&]() -> ExitCode { throw exception; });
  return {code, testing::internal::GetCapturedStderr()};
}

TEST(ExitCodes, ACommandsOwnCodeIsKept) {
  EXPECT_EQ(run_guarded([] { return ExitCode::no_result; }), ExitCode::no_result);
}

TEST(ExitCodes, EveryLineOfAFileErrorBeginsWithTheProgramsName) {
  const End end = end_of(FileError("g.toml", {{{2, 1}, "b", "second", ""}, {{1, 1}, "a", "first", ""}}));
  EXPECT_EQ(end.code, ExitCode::wrong_input);
  EXPECT_EQ(end.said, "strainwave: g.toml:1:1: a: first\nstrainwave: g.toml:2:1: b: second\n");
}

TEST(ExitCodes, WrongUseAndWrongFieldsAreTheUsersFault) {
  EXPECT_EQ(end_of(UsageError("no such thing")).code, ExitCode::wrong_input);
  EXPECT_EQ(end_of(FieldError("load.phases", "must be more")).said,
            "strainwave: load.phases: must be more\n");
}

TEST(ExitCodes, MemoryIsTheEnvironment) {
  const End end = end_of(std::bad_alloc());
  EXPECT_EQ(end.code, ExitCode::environment);
  EXPECT_EQ(end.said, "strainwave: out of memory; close other programs or take a coarser [mesh]\n");
}

TEST(ExitCodes, FilesAndPermissionsAreTheEnvironment) {
  const std::filesystem::filesystem_error error("cannot create directories", "/no/permission",
                                                std::make_error_code(std::errc::permission_denied));
  const End end = end_of(error);
  EXPECT_EQ(end.code, ExitCode::environment);
  EXPECT_EQ(end.said, "strainwave: cannot create or open /no/permission: Permission denied\n");
  EXPECT_EQ(end_of(std::system_error(ENOSPC, std::generic_category(), "cannot write x")).said,
            "strainwave: cannot write x: No space left on device\n");
}

TEST(ExitCodes, ABrokenPipeIsQuiet) {
  const End end = end_of(BrokenPipe(EPIPE, std::generic_category()));
  EXPECT_EQ(end.code, ExitCode::done);
  EXPECT_EQ(end.said, "");
}

TEST(ExitCodes, EverythingElseIsOurBug) {
  EXPECT_EQ(end_of(std::logic_error("index 7")).code, ExitCode::our_bug);
  EXPECT_EQ(end_of(std::logic_error("index 7")).said,
            "strainwave: a bug of strainwave, please report it: index 7\n");
  EXPECT_EQ(end_of(42).code, ExitCode::our_bug);
}

} // namespace
} // namespace strainwave::app
