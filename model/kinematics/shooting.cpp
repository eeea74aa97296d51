#include "strainwave/model/kinematics/shooting.hpp"

#include <cvodes/cvodes.h>
#include <fmt/format.h>
#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <cmath>
#include <memory>
#include <new>
#include <numbers>

namespace strainwave {
namespace {

// Each SUNDIALS object under a unique_ptr with its own release function.
struct Release {
  void operator()(SUNContext c) const { SUNContext_Free(&c); }
  void operator()(N_Vector v) const { N_VDestroy(v); }
  void operator()(SUNMatrix m) const { SUNMatDestroy(m); }
  void operator()(SUNLinearSolver s) const { SUNLinSolFree(s); }
  void operator()(SUNNonlinearSolver s) const { SUNNonlinSolFree(s); }
};
template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;
struct ReleaseCvodes {
  void operator()(void* memory) const { CVodeFree(&memory); }
};
struct ReleaseKinsol {
  void operator()(void* memory) const { KINFree(&memory); }
};

void stay_quiet(int, const char*, const char*, char*, void*) {}

template <class Pointer>
Pointer made(Pointer pointer) {
  if (!pointer)
    throw std::bad_alloc();
  return pointer;
}

SUNContext new_context() {
  SUNContext context = nullptr;
  if (SUNContext_Create(nullptr, &context) != 0)
    throw std::bad_alloc();
  return context;
}

/// The free arc. Lengths are divided by r_m so that all numbers are of order one.
struct FreeArc {
  double radius = 0.0, slope = 0.0, lift_off_y = 0.0;
};

int right_hand_side(double, N_Vector state, N_Vector rate, void* data) {
  const auto& arc = *static_cast<const FreeArc*>(data);
  const double* s = N_VGetArrayPointer(state);
  double* d = N_VGetArrayPointer(rate);
  d[0] = std::cos(s[2]);
  d[1] = std::sin(s[2]);
  d[2] = 1.0 / arc.radius + arc.slope * (s[1] - arc.lift_off_y);
  return 0;
}

class Shooter {
public:
  Shooter(const ElasticaProblem& problem, double tolerance)
      : problem_(problem), context_(new_context()), state_(made(N_VNew_Serial(3, context_.get()))),
        iteration_(made(SUNNonlinSol_FixedPoint(state_.get(), 0, context_.get()))),
        cvodes_(made(CVodeCreate(CV_ADAMS, context_.get()))) {
    CVodeSetErrHandlerFn(cvodes_.get(), stay_quiet, nullptr);
    CVodeInit(cvodes_.get(), right_hand_side, 0.0, state_.get());
    CVodeSStolerances(cvodes_.get(), tolerance, tolerance);
    CVodeSetUserData(cvodes_.get(), &arc_);
    CVodeSetNonlinearSolver(cvodes_.get(), iteration_.get());
    CVodeSetMaxNumSteps(cvodes_.get(), 10000);
  }

  SUNContext context() const { return context_.get(); }

  /// Unknowns (a, h r_m^2, e/u0) -> residuals (x/r_m at the minor axis, psi - pi there, the given number's
  /// misfit).
  bool residual(const double* unknown, double* misfit) {
    const double rm = problem_.neutral_radius_mm, a = unknown[0], e = unknown[2] * problem_.u0_mm / rm;
    const double radius = 1.0 + problem_.u0_mm / rm - e, length = 0.5 * std::numbers::pi - radius * a;
    if (!(radius > 0.0) || !(length > 0.0))
      return false;
    arc_ = {radius, unknown[1], radius * std::sin(a)};
    double* s = N_VGetArrayPointer(state_.get());
    s[0] = e + radius * std::cos(a);
    s[1] = arc_.lift_off_y;
    s[2] = 0.5 * std::numbers::pi + a;
    const double polar = std::atan2(s[1], s[0]);
    double reached = 0.0;
    if (CVodeReInit(cvodes_.get(), 0.0, state_.get()) != CV_SUCCESS)
      return false;
    CVodeSetStopTime(cvodes_.get(), length);
    if (CVode(cvodes_.get(), length, state_.get(), &reached, CV_NORMAL) < 0)
      return false;
    misfit[0] = s[0];
    misfit[1] = s[2] - std::numbers::pi;
    misfit[2] =
        problem_.eccentricity_given ? unknown[2] - problem_.given / problem_.u0_mm : polar - problem_.given;
    return true;
  }

private:
  ElasticaProblem problem_;
  Owned<SUNContext> context_;
  Owned<N_Vector> state_;
  Owned<SUNNonlinearSolver> iteration_;
  std::unique_ptr<void, ReleaseCvodes> cvodes_;
  FreeArc arc_;
};

int misfit_function(N_Vector unknown, N_Vector misfit, void* data) {
  // 1: recoverable, KINSOL shortens its step.
  return static_cast<Shooter*>(data)->residual(N_VGetArrayPointer(unknown), N_VGetArrayPointer(misfit)) ? 0
                                                                                                        : 1;
}

} // namespace

Outcome<LiftOff> shoot(const ElasticaProblem& problem, const LiftOff& start, double relative_tolerance) {
  const double rm = problem.neutral_radius_mm;
  Shooter shooter(problem, relative_tolerance);
  SUNContext context = shooter.context();
  const Owned<N_Vector> unknown(made(N_VNew_Serial(3, context))), scale(made(N_VNew_Serial(3, context)));
  const Owned<SUNMatrix> jacobian(made(SUNDenseMatrix(3, 3, context)));
  const Owned<SUNLinearSolver> linear(made(SUNLinSol_Dense(unknown.get(), jacobian.get(), context)));
  const std::unique_ptr<void, ReleaseKinsol> kinsol(made(KINCreate(context)));
  double* x = N_VGetArrayPointer(unknown.get());
  x[0] = start.arc_rad;
  x[1] = start.n_over_ei_per_mm2 * rm * rm;
  x[2] = start.eccentricity_mm / problem.u0_mm;
  N_VConst(1.0, scale.get());

  KINSetErrHandlerFn(kinsol.get(), stay_quiet, nullptr);
  KINSetUserData(kinsol.get(), &shooter);
  KINInit(kinsol.get(), misfit_function, unknown.get());
  KINSetLinearSolver(kinsol.get(), linear.get(), jacobian.get());
  KINSetMaxSetupCalls(kinsol.get(), 1); // the default keeps one Jacobian for ten iterations
  KINSetMaxNewtonStep(kinsol.get(), 10.0);
  KINSetFuncNormTol(kinsol.get(), 10.0 * relative_tolerance);
  KINSetScaledStepTol(kinsol.get(), relative_tolerance);
  const int flag = KINSol(kinsol.get(), unknown.get(), KIN_LINESEARCH, scale.get(), scale.get());
  if (flag < 0)
    return Failure{
        Status::not_converged,
        fmt::format("the elastica on two discs (r_m {} mm, u0 {} mm, e/u0 {:.4f}) has no solution near the "
                    "first-order one (KINSOL flag {})",
                    rm, problem.u0_mm, start.eccentricity_mm / problem.u0_mm, flag)};
  return LiftOff{x[0], x[1] / (rm * rm), x[2] * problem.u0_mm};
}

} // namespace strainwave
