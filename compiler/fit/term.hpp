// What a fitted network is made of: elements side by side, each linear in its own weight.
#pragma once

#include <cstddef>
#include <vector>

namespace dashpot::compiler::fitting {

enum class TermKind {
  spring,
  damper,
  maxwell,    // spring in series with a damper; in the compliance form the Kelvin element, both side by side
  stop,       // spring in series with a slip
  sliding,    // spring in series with a slip beside a damper: (21) of Gosline & Hayward 2009
  springpot,  // force K D^β u
  offset,     // of the force of one file: a tare, of either sign
  initial,    // force that a Maxwell branch of one file had at its first row, of either sign
};

struct Term {
  TermKind kind = TermKind::spring;
  double time = 0;       // τ of a Maxwell branch, and B/K of one that slides [s]
  double threshold = 0;  // d: elongation of the spring at which its slip yields [m]
  double exponent = 0;   // β of a springpot
  std::size_t file = 0;  // of an offset or an initial force
};

// Its weight may have either sign.
inline bool is_signed(const Term& term) { return term.kind == TermKind::offset || term.kind == TermKind::initial; }

// What a Maxwell branch held when its file began; both share their time to the last bit.
inline bool is_initial_of(const Term& initial, const Term& branch) {
  return initial.kind == TermKind::initial && branch.kind == TermKind::maxwell && initial.time == branch.time;
}

// How many numbers a term has beside its weight.
inline std::size_t shape_count(const Term& term) {
  switch (term.kind) {
    case TermKind::maxwell:
    case TermKind::stop:
    case TermKind::springpot: return 1;
    case TermKind::sliding: return 2;
    case TermKind::spring:
    case TermKind::damper:
    case TermKind::offset:
    case TermKind::initial: return 0;
  }
  return 0;
}

// Which quantity the recordings are a linear function of: stiffness (force follows position) or compliance (position
// follows force: creep, and motions whose force was controlled).
enum class Form { stiffness, compliance };

}  // namespace dashpot::compiler::fitting
