#pragma once

#include <span>
#include <string>

#include "apps/context.hpp"
#include "flow/flow_level.hpp"

namespace wingbeat {

// Where a flow w of the level is none, or its residual r not finite: says so in the log, and keeps it for the
// result as `breakdown`. Nothing where it is a flow. Collective.
void note_breakdown(Context& context, const FlowLevel<2>& level, std::span<const double> w,
                    std::span<const double> r = {});

// The same of a flow that cycles bring forward: notes each breakdown once.
class BreakdownWatch {
 public:
  BreakdownWatch(Context& context, const FlowLevel<2>& level) : context_(context), level_(level) {}
  void look(std::span<const double> w);  // collective

 private:
  Context& context_;
  const FlowLevel<2>& level_;
  bool is_broken_ = false;
};

// The message of a run that diverged, with the last breakdown if there was one.
std::string with_breakdown(const Result& result);

}  // namespace wingbeat
