// From a material to a tool: what turns stress and strain into force and displacement.
#pragma once

#include <optional>
#include <string>

#include "source/diagnostic.hpp"

namespace dashpot::compiler::fitting {

// f = stiffness_per_modulus · modulus · u. Of a bar the specimen's own force and displacement, else those of the tool.
struct Geometry {
  double stiffness_per_modulus = 0;  // [m]
  double length = 0;                 // displacement at strain one [m]
  double area = 0;                   // force at stress one [m²]
  std::string words;                 // as the command line gave it
  std::string sentence;              // for the file's source
};

// "KIND:KEY=VALUE,…", G the shear modulus, E Young's modulus, f the force at displacement u:
//   column:area=A,length=L                     f = E A u/L
//   shear:area=A,thickness=T                   f = G A u/T
//   punch:radius=A[,poisson=N]                 f = 8 G A u on an incompressible half-space (Sneddon 1965);
//                                              with Poisson's ratio N: f = 2 E A u/(1 − N²)
//   sphere:radius=R,depth=D[,poisson=N]        as a punch of radius √(R D): the tangent of Hertz's law at depth D
//   needle:radius=A,length=L,outer=R[,poisson=N]   f = 2π G L u/ln(R/A); with Poisson's ratio G = E/(2(1 + N))
// So for the last three a modulus is G unless a Poisson's ratio is given, and then E. Refuses: other words, with those
// that are known.
std::optional<Geometry> parse_geometry(const std::string& words, Diagnostics& diagnostics);

}  // namespace dashpot::compiler::fitting
