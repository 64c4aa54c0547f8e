#pragma once

#include <memory>

#include "adjoint/parameters.hpp"
#include "partition/local_nodes.hpp"

namespace wingbeat {

// What a rank's flow is made of before parameters change. Kept by reference: the base outlives its changes.
template <int Dim>
struct DomainBase {
  const Comm& comm;
  const LocalMesh<Dim>& mesh;
  const LocalNodes<Dim>& nodes;
  FlowModel<Dim, double> model;
  Vec<double, 2> axis{};  // of rotation, chords
  bool turns_about_elastic_axis = false;
};

// A model with its free stream changed.
template <int Dim>
FlowModel<Dim, double> changed_model(FlowModel<Dim, double> model, const Parameters<Dim>& change);

// The same after a finite change: nodes, free stream and axis moved. Not copied: parts refer to one another.
template <int Dim>
struct ChangedDomain {
  LocalMesh<Dim> mesh;
  FlowModel<Dim, double> model;
  FlowDomain<Dim> domain;
  FlowEquations<Dim> flow;

  // Throws SolveFailure where a cell has no positive volume. Collective.
  ChangedDomain(const DomainBase<Dim>& base, const Parameters<Dim>& change, const TimeSpectral& time);
  ChangedDomain(const ChangedDomain&) = delete;
  ChangedDomain& operator=(const ChangedDomain&) = delete;
};

}  // namespace wingbeat
