// Prony series as finite-element programs write them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "network/passive_prony.hpp"
#include "source/diagnostic.hpp"

namespace dashpot::compiler {

enum class PronyFormat { abaqus, febio, ansys, ls_dyna, generic };

std::string_view name_of(PronyFormat format);

// "the shear weights of *Viscoelastic are shares of the instantaneous stiffness", …: the convention in a sentence.
std::string_view convention_of(PronyFormat format);

struct PronyQuestion {
  PronyFormat format = PronyFormat::generic;
  std::optional<std::string> material;  // its name or number, where the file has several
  std::optional<PronyOf> of;            // generic: what its weights are shares of
};

// What a file says: of relative series the stiffness is 1, of FEBio's with <g0> it is that share.
// Refuses, with the place: a file without a series, with several and no --material, values that are no numbers, times
// of zero or less, a generic table that does not say what its weights are shares of.
std::optional<PronySeries> read_prony(const SourceFile& file, const PronyQuestion& question, Diagnostics& diagnostics);

// What a file says of itself in comments, as export writes them.
struct PronyRemarks {
  std::optional<PronyOf> of;             // "# of: instantaneous", of a generic table
  std::optional<std::string> stiffness;  // "** stiffness: 27 N/m": of which the weights are shares
  std::optional<std::string> modulus;    // "$ modulus: 1 N/m": what one of the file's units is in the network
};
PronyRemarks remarks_of(const SourceFile& file);

// How many terms the material of such a series can have, where it is known that the format has room for no more.
std::optional<std::size_t> most_terms_of(PronyFormat format, const PronySeries& series);

// The text of a file, or of the part of an input deck, in the format's own convention. Ensures: read_prony gives the
// same series, to the rounding of one division by a stiffness. In: a series that is passive and relaxes.
// `unit`: of the series' stiffness.
std::string write_prony(const PronySeries& series, PronyFormat format, const std::string& name,
                        const std::string& unit);

// The series with weights that are shares of another stiffness; the same relaxation function.
PronySeries in_convention(const PronySeries& series, PronyOf of);

}  // namespace dashpot::compiler
