#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "optimize/evaluation_record.hpp"
#include "optimize/evaluation_service.hpp"

namespace wingbeat {

// A number made of outputs of analyses.
struct DerivedOutput {
  std::string name;
  std::vector<std::string> of;
  // The number, and its derivative with respect to each of `of`.
  std::function<double(std::span<const double> values, std::span<double> weights)> combine;
};

// A number of the shape alone.
struct GeometricOutput {
  std::string name;
  // The number, and its derivative with respect to each variable.
  std::function<double(std::span<const double> design, std::span<double> derivatives)> measure;
};

// All that objective and constraints may name, at design after design: analysed once each, and recorded. On
// rank 0, while the others serve.
class DesignOutputs {
 public:
  // Service and record are kept by reference.
  DesignOutputs(EvaluationService& service, EvaluationRecord& record, std::vector<DerivedOutput> derived,
                std::vector<GeometricOutput> geometric);

  // Takes note of analyses that the service has come to have.
  void refresh();

  const std::vector<std::string>& names() const { return names_; }
  std::size_t index(const std::string& name) const;  // of a name that there is

  // One number a name, or [name][variable]; nothing where an analysis failed: why() then says so.
  std::optional<std::vector<double>> values(std::span<const double> design);
  std::optional<std::vector<std::vector<double>>> gradients(std::span<const double> design);
  const std::string& why() const { return why_; }

 private:
  const Evaluation& evaluate(std::span<const double> design);

  EvaluationService& service_;
  EvaluationRecord& record_;
  std::vector<DerivedOutput> derived_;
  std::vector<GeometricOutput> geometric_;
  std::vector<std::vector<std::size_t>> parts_;  // of each derived output, among the analyses'
  std::vector<std::string> names_;
  std::string why_;
};

}  // namespace wingbeat
