#pragma once

#include <type_traits>

#include "flow/block_geometry.hpp"
#include "flow/motion.hpp"

namespace wingbeat {

// Area vector and swept volume rate of a face in rigid motion.
template <int Dim, class T>
struct MovedFace {
  Vec<T, Dim> normal;
  T sweep;
};

// Face (or lanes<T> consecutive faces) at offset o of direction d.
template <int Dim, class T>
MovedFace<Dim, T> moved_face(const BlockGeometry<Dim>& geometry, const RigidMotion<T>& motion, int d,
                             std::ptrdiff_t o) {
  using Stored = std::conditional_t<std::is_same_v<T, Pack>, Pack, double>;
  Vec<T, Dim> normal;
  for (int c = 0; c < Dim; ++c) normal[c] = T(Load<Stored>::from(geometry.normal[d][c].data() + o));
  const T moment(Load<Stored>::from(geometry.moment[d].data() + o));
  MovedFace<Dim, T> face;
  face.normal = motion.turned(normal);
  face.sweep = motion.sweep(face.normal, moment);
  return face;
}

// Means of the two faces of the cell at offset o in each direction.
template <int Dim, class T>
struct CellFaces {
  Vec<Vec<T, Dim>, Dim> normals;
  Vec<T, Dim> sweeps;
};
template <int Dim, class T>
CellFaces<Dim, T> mean_faces(const BlockGeometry<Dim>& geometry, const RigidMotion<T>& motion, std::ptrdiff_t o) {
  CellFaces<Dim, T> mean;
  for (int d = 0; d < Dim; ++d) {
    const auto low = moved_face<Dim, T>(geometry, motion, d, o);
    const auto high = moved_face<Dim, T>(geometry, motion, d, o + geometry.layout.strides[d]);
    mean.normals[d] = 0.5 * (low.normal + high.normal);
    mean.sweeps[d] = 0.5 * (low.sweep + high.sweep);
  }
  return mean;
}

// The same motion for every lane of a pack.
inline RigidMotion<Pack> widen(const RigidMotion<double>& m) {
  return {Pack(m.cosine), Pack(m.sine), Pack(m.pitch_rate), Pack(m.plunge_rate)};
}
template <class T, int N>
RigidMotion<Dual<T, N>> widen(const RigidMotion<Dual<T, N>>& m) {
  return m;
}

}  // namespace wingbeat
