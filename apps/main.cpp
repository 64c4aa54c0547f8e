#include <fmt/format.h>

#include <cstdio>

#include "apps/command_line.hpp"
#include "apps/plot.hpp"
#include "apps/reference.hpp"
#include "apps/run_case.hpp"
#include "core/io/error.hpp"
#include "core/parallel/comm.hpp"

namespace wingbeat {

namespace {

int run_program(const Comm& comm, const std::vector<std::string>& arguments) {
  CommandLine command;
  try {
    command = parse_command_line(arguments);
    if (comm.is_root()) fmt::print("{}", command.answer);
    if (!command.answer.empty()) return exit_converged;
    if (command.verb == "reference") {
      if (comm.is_root()) fmt::print("{}", command.markdown ? reference_page() : reference_text());
      return exit_converged;
    }
    if (command.verb == "plot") {
      if (comm.is_root()) plot_results(command.target);
      return exit_converged;
    }
  } catch (const InputError& error) {
    if (comm.is_root()) fmt::print(stderr, "wingbeat: {}\n", error.what());
    return exit_bad_input;
  }
  return run_case(comm, command);
}

}  // namespace

}  // namespace wingbeat

int main(int argc, char** argv) {
  const wingbeat::MpiSession session(argc, argv);
  const wingbeat::Comm comm;
  return wingbeat::run_program(comm, {argv + 1, argv + argc});
}
