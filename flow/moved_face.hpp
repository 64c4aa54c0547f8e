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

// Face at rest: area vector and moment about the axis of rotation.
template <int Dim, class T>
struct RestingFace {
  Vec<T, Dim> normal;
  T moment;
};

// A geometry with a change of it: its faces carry the change as the gradient.
template <int Dim>
struct ChangedGeometry {
  const BlockGeometry<Dim>& at;
  const BlockGeometry<Dim>& change;
  const BlockLayout<Dim>& layout = at.layout;
};

// Face (or lanes<T> consecutive faces) at offset o of direction d.
template <int Dim, class T>
RestingFace<Dim, T> resting_face(const BlockGeometry<Dim>& geometry, int d, std::ptrdiff_t o) {
  using Stored = std::conditional_t<std::is_same_v<T, Pack>, Pack, double>;
  RestingFace<Dim, T> face;
  for (int c = 0; c < Dim; ++c) face.normal[c] = T(Load<Stored>::from(geometry.normal[d][c].data() + o));
  face.moment = T(Load<Stored>::from(geometry.moment[d].data() + o));
  return face;
}

template <int Dim, class T>
RestingFace<Dim, T> resting_face(const ChangedGeometry<Dim>& geometry, int d,
                                 std::ptrdiff_t o) requires std::is_same_v<T, Dual<double, 1>> {
  RestingFace<Dim, T> face = resting_face<Dim, T>(geometry.at, d, o);
  const auto change = resting_face<Dim, double>(geometry.change, d, o);
  for (int c = 0; c < Dim; ++c) face.normal[c].gradient[0] = change.normal[c];
  face.moment.gradient[0] = change.moment;
  return face;
}

template <int Dim, class T>
MovedFace<Dim, T> moved(const RestingFace<Dim, T>& face, const RigidMotion<T>& motion) {
  const Vec<T, Dim> normal = motion.turned(face.normal);
  return {normal, motion.sweep(normal, face.moment)};
}

template <int Dim, class T, class Geometry>
MovedFace<Dim, T> moved_face(const Geometry& geometry, const RigidMotion<T>& motion, int d,
                             std::ptrdiff_t o) {
  return moved(resting_face<Dim, T>(geometry, d, o), motion);
}

// Means of the two faces of the cell at offset o in each direction, at rest.
template <int Dim, class T, class Geometry>
Vec<RestingFace<Dim, T>, Dim> mean_resting_faces(const Geometry& geometry, std::ptrdiff_t o) {
  Vec<RestingFace<Dim, T>, Dim> mean;
  for (int d = 0; d < Dim; ++d) {
    const auto low = resting_face<Dim, T>(geometry, d, o);
    const auto high = resting_face<Dim, T>(geometry, d, o + geometry.layout.strides[d]);
    mean[d] = {0.5 * (low.normal + high.normal), 0.5 * (low.moment + high.moment)};
  }
  return mean;
}

// The same in motion.
template <int Dim, class T>
struct CellFaces {
  Vec<Vec<T, Dim>, Dim> normals;
  Vec<T, Dim> sweeps;
};
template <int Dim, class T>
CellFaces<Dim, T> moved(const Vec<RestingFace<Dim, T>, Dim>& resting, const RigidMotion<T>& motion) {
  CellFaces<Dim, T> faces;
  for (int d = 0; d < Dim; ++d) {
    const auto face = moved(resting[d], motion);
    faces.normals[d] = face.normal;
    faces.sweeps[d] = face.sweep;
  }
  return faces;
}
template <int Dim, class T, class Geometry>
CellFaces<Dim, T> mean_faces(const Geometry& geometry, const RigidMotion<T>& motion, std::ptrdiff_t o) {
  return moved(mean_resting_faces<Dim, T>(geometry, o), motion);
}

// The same motion for every lane of a pack.
inline RigidMotion<Pack> widen(const RigidMotion<double>& m) {
  return {Pack(m.cosine), Pack(m.sine), Pack(m.pitch_rate), Pack(m.plunge_rate)};
}
template <int N>
RigidMotion<Dual<Pack, N>> widen_to_dual(const RigidMotion<double>& m) {
  return {Pack(m.cosine), Pack(m.sine), Pack(m.pitch_rate), Pack(m.plunge_rate)};
}
template <class T, int N>
RigidMotion<Dual<T, N>> widen(const RigidMotion<Dual<T, N>>& m) {
  return m;
}

}  // namespace wingbeat
