#include "optimize/ipopt_adapter.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <IpCompoundVector.hpp>
#include <IpIpoptApplication.hpp>
#include <IpIpoptCalculatedQuantities.hpp>
#include <IpIpoptData.hpp>
#include <IpRegOptions.hpp>
#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <exception>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>

#include "core/io/error.hpp"
#include "optimize/ipopt_evaluations.hpp"
#include "optimize/ipopt_lines.hpp"
#include "optimize/ipopt_options.hpp"

namespace wingbeat {
namespace {

using Ipopt::Index;
using Ipopt::Number;
using Ipopt::SmartPtr;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
// Beyond the 1e19 from which on Ipopt takes a bound for none.
constexpr double no_bound = 2e19;

std::span<const double> view(const Number* numbers, Index count) {
  return {numbers, static_cast<std::size_t>(count)};
}

std::vector<double> copy(const Number* numbers, Index count) { return {numbers, numbers + count}; }

// Points of one iteration. Where constraints hold, Ipopt halves a step that does not descend or cannot be
// evaluated down to round-off, takes what is left of it, and does so again in the next iteration.
constexpr std::size_t most_trials = 20;
struct TooManyTrials {};

// The programme in Ipopt's terms, with a dense Jacobian. An exception of the programme is kept and goes on
// through Ipopt.
class IpoptProgram final : public Ipopt::TNLP {
 public:
  explicit IpoptProgram(NonlinearProgram& program) : program_(program), evaluations_(program) {
    result_.x = evaluations_.start();
    result_.objective = result_.kkt_error = no_number;
  }

  void rethrow_exception() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }
  bool has_just_failed() const { return evaluations_.has_just_failed(); }
  OptimizerResult take_result() { return std::move(result_); }

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jac_g, Index& nnz_h_lag, IndexStyleEnum& style) override {
    n = static_cast<Index>(evaluations_.bounds().x_lower.size());
    m = static_cast<Index>(evaluations_.bounds().g_lower.size());
    nnz_jac_g = n * m;
    nnz_h_lag = 0;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index, Number* x_l, Number* x_u, Index, Number* g_l, Number* g_u) override {
    const auto limited = [](double bound) { return std::clamp(bound, -no_bound, no_bound); };
    std::ranges::transform(evaluations_.bounds().x_lower, x_l, limited);
    std::ranges::transform(evaluations_.bounds().x_upper, x_u, limited);
    std::ranges::transform(evaluations_.bounds().g_lower, g_l, limited);
    std::ranges::transform(evaluations_.bounds().g_upper, g_u, limited);
    return true;
  }

  bool get_starting_point(Index, bool, Number* x, bool init_z, Number*, Number*, Index, bool init_lambda,
                          Number*) override {
    std::ranges::copy(evaluations_.start(), x);
    return !init_z && !init_lambda;
  }

  bool eval_f(Index n, const Number* x, bool, Number& value) override {
    const ProgramValues* values = values_at(view(x, n));
    if (values) value = values->objective;
    return values != nullptr;
  }

  bool eval_g(Index n, const Number* x, bool, Index, Number* g) override {
    const ProgramValues* values = values_at(view(x, n));
    if (values) std::ranges::copy(values->constraints, g);
    return values != nullptr;
  }

  bool eval_grad_f(Index n, const Number* x, bool, Number* gradient) override {
    const ProgramGradients* gradients = guarded([&] { return evaluations_.gradients(view(x, n)); });
    if (gradients) std::ranges::copy(gradients->objective, gradient);
    // Asked for at iterates alone: here the result is, should Ipopt come to no end of its own.
    keep_point(view(x, n));
    return gradients != nullptr;
  }

  bool eval_jac_g(Index n, const Number* x, bool, Index m, Index, Index* rows, Index* columns,
                  Number* jacobian) override {
    if (!jacobian) {
      for (Index i = 0; i < m; ++i)
        for (Index j = 0; j < n; ++j) *rows++ = i, *columns++ = j;
      return true;
    }
    const ProgramGradients* gradients = guarded([&] { return evaluations_.gradients(view(x, n)); });
    if (gradients) std::ranges::copy(gradients->constraints, jacobian);
    return gradients != nullptr;
  }

  bool intermediate_callback(Ipopt::AlgorithmMode mode, Index iteration, Number objective,
                             Number primal_infeasibility, Number, Number barrier, Number, Number, Number,
                             Number, Index trials, const Ipopt::IpoptData* data,
                             Ipopt::IpoptCalculatedQuantities* quantities) override {
    const bool is_restoring = mode == Ipopt::RestorationPhaseMode;
    result_.iterations = iteration;
    has_iterated_ = true;
    points_before_iteration_ = evaluations_.point_count();
    const ProgramIteration state{
        .iteration = iteration,
        .objective = objective,
        // The quantities of a restoration are those of its own problem.
        .infeasibility = is_restoring ? primal_infeasibility
                                      : quantities->unscaled_curr_nlp_constraint_violation(Ipopt::NORM_MAX),
        .kkt_error = quantities->curr_nlp_error(),
        .barrier = barrier,
        .step = change_of_variables(data->curr()->x()),
        .trials = trials,
        .is_restoring = is_restoring};
    if (!is_restoring) result_.kkt_error = state.kkt_error;
    return guarded([&] { return program_.observe(state); });
  }

  void finalize_solution(Ipopt::SolverReturn status, Index n, const Number* x, const Number* z_l,
                         const Number* z_u, Index m, const Number* g, const Number* lambda, Number objective,
                         const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities* quantities) override {
    // With these Ipopt fills in zeros.
    const bool has_numbers = status != Ipopt::INVALID_NUMBER_DETECTED && status != Ipopt::INTERNAL_ERROR &&
                             status != Ipopt::OUT_OF_MEMORY && status != Ipopt::INVALID_OPTION;
    if (!keep_point(view(x, n)) && has_numbers) {
      result_.objective = objective;
      result_.constraints = copy(g, m);
    }
    // Without quantities where every variable is fixed.
    result_.kkt_error = has_numbers && quantities ? quantities->curr_nlp_error() : no_number;
    if (!has_numbers) return;
    result_.constraint_multipliers = copy(lambda, m);
    result_.lower_multipliers = copy(z_l, n);
    result_.upper_multipliers = copy(z_u, n);
  }

 private:
  template <class Call>
  std::invoke_result_t<const Call&> guarded(const Call& call) {
    try {
      return call();
    } catch (...) {
      thrown_ = std::current_exception();
      throw;
    }
  }

  const ProgramValues* values_at(std::span<const double> x) {
    if (has_iterated_ && evaluations_.is_new(x) &&
        evaluations_.point_count() >= points_before_iteration_ + most_trials)
      throw TooManyTrials();
    return guarded([&] { return evaluations_.values(x); });
  }

  // False where its values are not known.
  bool keep_point(std::span<const double> x) {
    const ProgramValues* values = evaluations_.known_values(x);
    result_.x.assign(x.begin(), x.end());
    result_.objective = values ? values->objective : no_number;
    result_.constraints = values ? values->constraints : std::vector<double>();
    return values != nullptr;
  }

  // Since the last iteration. The variables of a restoration are ours and the slacks of its own.
  double change_of_variables(const SmartPtr<const Ipopt::Vector>& all) {
    const auto* compound = dynamic_cast<const Ipopt::CompoundVector*>(Ipopt::GetRawPtr(all));
    const SmartPtr<const Ipopt::Vector> x = compound ? compound->GetComp(0) : all;
    double change = 0.0;
    if (Ipopt::IsValid(last_x_)) {
      const SmartPtr<Ipopt::Vector> difference = x->MakeNewCopy();
      difference->Axpy(-1.0, *last_x_);
      change = difference->Amax();
    }
    last_x_ = x;
    return change;
  }

  NonlinearProgram& program_;
  ProgramEvaluations evaluations_;
  SmartPtr<const Ipopt::Vector> last_x_;
  bool has_iterated_ = false;
  std::size_t points_before_iteration_ = 0;
  OptimizerResult result_;
  std::exception_ptr thrown_;
};

class LineJournal final : public Ipopt::Journal {
 public:
  // Ipopt applies its option print_level to the journal of this name alone.
  explicit LineJournal(std::function<void(std::string_view)> print_line)
      : Journal("console", Ipopt::J_ITERSUMMARY), lines_(std::move(print_line)) {
    SetPrintLevel(Ipopt::J_DBG, Ipopt::J_NONE);
  }

  void finish() { lines_.finish(); }

 protected:
  void PrintImpl(Ipopt::EJournalCategory, Ipopt::EJournalLevel, const char* text) override {
    lines_.add(text);
  }

  void PrintfImpl(Ipopt::EJournalCategory, Ipopt::EJournalLevel, const char* format,
                  va_list arguments) override {
    va_list measured;
    va_copy(measured, arguments);
    const int length = std::vsnprintf(nullptr, 0, format, measured);
    va_end(measured);
    if (length <= 0) return;
    std::string text(static_cast<std::size_t>(length), '\0');
    std::vsnprintf(text.data(), text.size() + 1, format, arguments);
    lines_.add(text);
  }

  void FlushBufferImpl() override {}

 private:
  LineSplitter lines_;
};

Bounds range_of(const Ipopt::RegisteredOption& option) {
  Bounds range;
  const bool is_integer = option.Type() == Ipopt::OT_Integer;
  if (option.HasLower()) {
    range.lower = is_integer ? option.LowerInteger() : option.LowerNumber();
    range.lower_open = !is_integer && option.LowerStrict();
  }
  if (option.HasUpper()) {
    range.upper = is_integer ? option.UpperInteger() : option.UpperNumber();
    range.upper_open = !is_integer && option.UpperStrict();
  }
  return range;
}

IpoptOptionRule rule_of(const Ipopt::RegisteredOption& option) {
  using Kind = IpoptOptionRule::Kind;
  if (option.Type() != Ipopt::OT_String)
    return {.name = option.Name(),
            .kind = option.Type() == Ipopt::OT_Integer ? Kind::integer : Kind::number,
            .range = range_of(option)};
  IpoptOptionRule rule{.name = option.Name(), .kind = Kind::text};
  for (const auto& entry : option.GetValidStrings()) rule.allowed.push_back(entry.value_);
  return rule;
}

std::vector<IpoptOptionRule> registered_rules(Ipopt::IpoptApplication& application) {
  std::vector<IpoptOptionRule> rules;
  for (const auto& [name, option] : application.RegOptions()->RegisteredOptionsList())
    rules.push_back(rule_of(*option));
  return rules;
}

SmartPtr<Ipopt::IpoptApplication> silent_application() {
  const bool has_console = false;
  return new Ipopt::IpoptApplication(has_console);
}

// A prefix of the name, as in resto.tol, keeps the option to a part of Ipopt.
void set_option(Ipopt::OptionsList& list, const IpoptAssignment& given,
                std::span<const IpoptOptionRule> rules) {
  using Kind = IpoptOptionRule::Kind;
  const auto rule =
      std::ranges::find(rules, given.name.substr(given.name.find('.') + 1), &IpoptOptionRule::name);
  const bool is_set =
      rule != rules.end() &&
      (rule->kind == Kind::number    ? list.SetNumericValue(given.name, parse_number(given.value).value())
       : rule->kind == Kind::integer ? list.SetIntegerValue(given.name, parse_integer(given.value).value())
                                     : list.SetStringValue(given.name, given.value));
  ensure(is_set, fmt::format("Ipopt refuses {} = {}", given.name, given.value));
}

struct Ending {
  OptimizerStatus status;
  std::string message;
};

Ending ending_of(Ipopt::ApplicationReturnStatus status, const IpoptOptions& options) {
  using enum OptimizerStatus;
  switch (status) {
    case Ipopt::Solve_Succeeded:
      return {converged, fmt::format("the optimality conditions hold to {}", options.tolerance)};
    case Ipopt::Feasible_Point_Found:
      return {converged, "as many equality constraints as free variables, which alone determine the point"};
    case Ipopt::Solved_To_Acceptable_Level:
      return {acceptable, "no better than the acceptable tolerances for many iterations"};
    case Ipopt::Maximum_Iterations_Exceeded:
      return {iteration_limit, fmt::format("{} iterations, as many as allowed", options.max_iterations)};
    case Ipopt::Infeasible_Problem_Detected:
      return {infeasible, "no point nearby violates the constraints less; no feasible one was found"};
    case Ipopt::User_Requested_Stop:
      return {stopped, "stopped as asked"};
    case Ipopt::Maximum_CpuTime_Exceeded:
      return {stopped, "the limit max_cpu_time is reached"};
    case Ipopt::Search_Direction_Becomes_Too_Small:
      return {stalled, "steps have become too small to change the variables"};
    case Ipopt::Diverging_Iterates:
      return {stalled, "the variables grow without bound; the objective may have no minimum"};
    case Ipopt::Restoration_Failed:
      return {stalled, "no step is acceptable and feasibility cannot be improved; gradients may be inexact"};
    case Ipopt::Error_In_Step_Computation:
      return {stalled, "the linear system of a step cannot be solved; gradients may be inexact"};
    case Ipopt::Invalid_Number_Detected:
      return {evaluation_failed, "a point that Ipopt cannot do without cannot be evaluated"};
    case Ipopt::Not_Enough_Degrees_Of_Freedom:
      throw InputError(
          "more equality constraints than free variables: give variables room between their bounds, or "
          "constraints an interval");
    case Ipopt::Invalid_Option:
      throw InputError(fmt::format("Ipopt cannot run with its options {}: its last lines say why",
                                   fmt::join(options.extra, ", ")));
    case Ipopt::Insufficient_Memory:
      throw std::bad_alloc();
    default:
      throw InternalError(fmt::format("Ipopt ended with status {}", static_cast<int>(status)));
  }
}

Ending solve(Ipopt::IpoptApplication& application, const SmartPtr<IpoptProgram>& program,
             LineJournal& journal, const IpoptOptions& options) {
  Ipopt::ApplicationReturnStatus status = Ipopt::Internal_Error;
  try {
    status = application.OptimizeTNLP(Ipopt::GetRawPtr(program));
  } catch (const TooManyTrials&) {
    journal.finish();
    return {OptimizerStatus::stalled,
            fmt::format("none of {} points along the step is better; gradients may be inexact", most_trials)};
  } catch (...) {
    journal.finish();
    throw;
  }
  journal.finish();
  // Ipopt makes a status even of some exceptions.
  program->rethrow_exception();
  return ending_of(status, options);
}

}  // namespace

std::string_view to_string(OptimizerStatus status) {
  constexpr std::array<std::string_view, 7> names{"converged", "acceptable", "iteration limit",  "infeasible",
                                                  "stalled",   "stopped",    "evaluation failed"};
  return names.at(static_cast<std::size_t>(status));
}

std::vector<std::string> ipopt_option_faults(std::span<const std::string> extra) {
  return assignment_faults(extra, registered_rules(*silent_application()));
}

OptimizerResult run_ipopt(NonlinearProgram& program, const IpoptOptions& options,
                          const std::function<void(std::string_view)>& print_line) {
  const SmartPtr<Ipopt::IpoptApplication> application = silent_application();
  const auto rules = registered_rules(*application);
  if (const auto faults = assignment_faults(options.extra, rules); !faults.empty())
    throw InputError(fmt::format("{}", fmt::join(faults, "\n")));
  const SmartPtr<LineJournal> journal = new LineJournal(print_line);
  application->Jnlst()->AddJournal(Ipopt::GetRawPtr(journal));
  application->RethrowNonIpoptException(true);
  for (const IpoptAssignment& given : own_assignments(options.max_iterations, options.tolerance))
    set_option(*application->Options(), given, rules);
  set_option(*application->Options(), {"theta_max_fact", fmt::format("{}", options.largest_violation)},
             rules);
  for (const std::string& text : options.extra)
    set_option(*application->Options(), *parse_assignment(text), rules);
  // Without a name no file of options is read.
  ensure(application->Initialize(std::string()) == Ipopt::Solve_Succeeded, "Ipopt cannot be initialised");

  const SmartPtr<IpoptProgram> ipopt_program = new IpoptProgram(program);
  Ending ending = solve(*application, ipopt_program, *journal, options);
  const bool is_stalled = ending.status == OptimizerStatus::stalled;
  if (is_stalled && ipopt_program->has_just_failed())
    ending = {OptimizerStatus::evaluation_failed, ending.message + "; the last point cannot be evaluated"};
  OptimizerResult result = ipopt_program->take_result();
  result.status = ending.status;
  result.message = std::move(ending.message);
  return result;
}

}  // namespace wingbeat
