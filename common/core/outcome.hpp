#pragma once
// What comes back when a design may have no result. Not an exception: a gear that cannot be computed is data
// for a study.

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace strainwave {

/// Why a well-formed gear has no result. One clear sentence per value: status_sentence().
enum class Status {
  ok,
  contradiction,           ///< numbers of the file contradict each other
  no_wrap,                 ///< the wave generator's numbers admit no wrap angle
  singular_wave_generator, ///< a shape formula has its pole here
  flank_outside_tooth,     ///< no involute flank between the given radii
  no_overlap,              ///< the flanks of no tooth reach each other
  no_contact,              ///< no tooth touches up to the given rotation
  not_available,           ///< this fidelity cannot treat this wave generator
  ill_conditioned,         ///< numbers so extreme that double precision cannot solve the equations
  not_converged,           ///< an iteration ended without a solution
  certificate_failed       ///< a result was found, but its residuals are too large
};

std::string_view status_name(Status status);

/// No result, and the sentence with the offending numbers that explains why.
struct Failure {
  Status status = Status::contradiction;
  std::string message;
};

/// A value or a Failure. value() on a failure is our own bug and throws std::logic_error.
template <class T>
class [[nodiscard]] Outcome {
public:
  Outcome(T value) : content_(std::move(value)) {}           // NOLINT: implicit on purpose
  Outcome(Failure failure) : content_(std::move(failure)) {} // NOLINT: implicit on purpose

  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }
  const T& value() const& {
    if (!ok())
      throw std::logic_error("Outcome::value() on a failure: " + failure().message);
    return std::get<0>(content_);
  }
  T&& value() && {
    if (!ok())
      throw std::logic_error("Outcome::value() on a failure: " + failure().message);
    return std::get<0>(std::move(content_));
  }
  const T& operator*() const& { return value(); }
  const T* operator->() const { return &value(); }
  const Failure& failure() const { return std::get<1>(content_); }

private:
  std::variant<T, Failure> content_;
};

} // namespace strainwave
