#include "app/exit_codes.hpp"

#include "app/output.hpp"
#include "strainwave/common/core/memory.hpp"
#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/gear_file/file_error.hpp"

#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

namespace strainwave::app {

namespace {

std::string sentence_of(const std::filesystem::filesystem_error& error) {
  std::string sentence = error.code().message();
  if (!error.path1().empty())
    sentence = "cannot create or open " + error.path1().string() + ": " + sentence;
  return sentence;
}

ExitCode end(ExitCode code, std::string_view sentence) {
  report(sentence);
  return code;
}

} // namespace

ExitCode run_guarded(const std::function<ExitCode()>& command) noexcept {
  try {
    const ExitCode code = command();
    flush_output();
    return code;
  } catch (const BrokenPipe&) {
    return ExitCode::done; // the reader has seen enough
  } catch (const UsageError& error) {
    return end(ExitCode::wrong_input, error.what());
  } catch (const FileError& error) {
    return end(ExitCode::wrong_input, error.what());
  } catch (const FieldError& error) {
    return end(ExitCode::wrong_input, error.what());
  } catch (const OutOfMemory& error) {
    return end(ExitCode::environment, error.what());
  } catch (const std::bad_alloc&) {
    return end(ExitCode::environment, "out of memory; close other programs or take a coarser [mesh]");
  } catch (const std::filesystem::filesystem_error& error) {
    return end(ExitCode::environment, sentence_of(error));
  } catch (const std::system_error& error) {
    return end(ExitCode::environment, error.what());
  } catch (const std::exception& error) {
    return end(ExitCode::our_bug, std::string("a bug of strainwave, please report it: ") + error.what());
  } catch (...) {
    return end(ExitCode::our_bug, "a bug of strainwave, please report it: an unknown exception");
  }
}

void install_process_habits() {
  std::signal(SIGPIPE, SIG_IGN);
  std::set_terminate([] {
    report("a bug of strainwave, please report it: an exception where none is allowed");
    std::_Exit(static_cast<int>(ExitCode::our_bug));
  });
}

} // namespace strainwave::app
