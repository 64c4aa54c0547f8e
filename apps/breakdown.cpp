#include "apps/breakdown.hpp"

#include "flow/flow_fault.hpp"

namespace wingbeat {

void note_breakdown(Context& context, const FlowLevel<2>& level, std::span<const double> w,
                    std::span<const double> r) {
  const std::string where = describe_fault<2>(level, w, r);
  if (where.empty()) return;
  context.log.line("  no flow any more: {}", where);
  context.result.findings["breakdown"] = where;
}

void BreakdownWatch::look(std::span<const double> w) {
  const bool was_broken = is_broken_;
  is_broken_ = level_.comm().any(!is_physical<2>(w, context_.settings.flow.gamma));
  if (is_broken_ && !was_broken) note_breakdown(context_, level_, w);
}

std::string with_breakdown(const Result& result) {
  const auto found = result.findings.find("breakdown");
  if (found == result.findings.end()) return result.message;
  return result.message + "; the flow broke down in " + found->get<std::string>();
}

}  // namespace wingbeat
