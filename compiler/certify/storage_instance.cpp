#include "certify/storage_instance.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "certify/adaptive_window.hpp"
#include "linear/real.hpp"

namespace dashpot::compiler {
namespace {

using dashpot_check::Integer;
using IntegerMatrix = dashpot_check::Matrix;
using RationalMatrix = std::vector<std::vector<Rational>>;

std::string list_of(const std::vector<std::string>& items) { return fmt::format("[{}]", fmt::join(items, "; ")); }

// Binary digits that Coq computes with: of A, of the share of V that pays for the others, and of witnesses, at most,
// which have no more than Real.
struct Precision {
  unsigned kept, slack;
  int witness;
};

// In hexadecimal, which Coq reads four times as fast.
std::string number_text(const Integer& value) {
  return (value < 0 ? "-0x" : "0x") + Integer(abs(value)).str(0, std::ios_base::hex);
}

std::vector<std::string> texts(const std::vector<Integer>& row) {
  std::vector<std::string> items;
  for (const Integer& value : row) items.push_back(number_text(value));
  return items;
}

std::string row_text(const std::vector<Integer>& row) { return list_of(texts(row)); }

// Every diagonal entry with what is right of it.
std::string form_text(const IntegerMatrix& form) {
  std::vector<std::string> items;
  for (std::size_t i = 0; i < form.size(); ++i)
    items.push_back(fmt::format("({}, {})", number_text(form[i][i]),
                                row_text({form[i].begin() + std::ptrdiff_t(i) + 1, form[i].end()})));
  return list_of(items);
}

unsigned digits_of(const RationalMatrix& matrix) {
  unsigned digits = 0;
  for (const auto& row : matrix)
    for (const Rational& value : row) digits = std::max(digits, unsigned(msb(Integer(denominator(value)))));
  return digits;
}

Integer scaled(const Rational& value, unsigned digits) { return (numerator(value) << digits) / denominator(value); }

IntegerMatrix scaled(const RationalMatrix& matrix, unsigned digits) {
  IntegerMatrix result;
  for (const auto& row : matrix) {
    result.emplace_back();
    for (const Rational& value : row) result.back().push_back(scaled(value, digits));
  }
  return result;
}

// Drops the last digits, rounding down as Z.shiftr does.
Integer without_last(const Integer& value, unsigned digits) {
  if (value >= 0) return value >> digits;
  return -((-value + (Integer(1) << digits) - 1) >> digits);
}

Rational power_of_two(int exponent) {
  return exponent >= 0 ? Rational(Integer(1) << exponent) : Rational(1, Integer(1) << -exponent);
}

// Whether what is left of M is diagonally dominant.
bool is_dominant(const IntegerMatrix& M, const IntegerMatrix& squared) {
  for (std::size_t i = 0; i < M.size(); ++i) {
    Integer spare = M[i][i] - squared[i][i];
    for (std::size_t j = 0; j < M.size(); ++j)
      if (j != i) spare -= abs(M[i][j] - squared[i][j]);
    if (spare < 0) return false;
  }
  return true;
}

// Columns of L and k with M − k L Lᵀ diagonally dominant for every M, which differ by little; tried with smaller and
// smaller margins, down to what is rounded.
std::optional<std::string> witness_of(const std::vector<IntegerMatrix>& all, int fraction) {
  const IntegerMatrix& M = all.front();
  const std::size_t n = M.size();
  Integer largest = 0;
  for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, M[i][i]);
  if (largest == 0) return "([], 1%positive)";
  const int exponent = std::max(0, int(msb(largest)) / 2 - fraction);
  const Integer k = Integer(1) << (2 * exponent);
  std::vector<std::vector<Real>> unit(n, std::vector<Real>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) unit[i][j] = Real(M[i][j]) / Real(k);
  for (int margin = 12; margin <= fraction; margin += 4) {
    std::vector<std::vector<Real>> L(n, std::vector<Real>(n, Real(0)));
    bool runs = true;
    for (std::size_t i = 0; runs && i < n; ++i)
      for (std::size_t j = 0; runs && j <= i; ++j) {
        Real sum = unit[i][j] * (i == j ? 1 - std::ldexp(1.0, -margin) : 1);
        for (std::size_t q = 0; q < j; ++q) sum -= L[i][q] * L[j][q];
        if (unit[j][j] == 0) continue;
        runs = i != j || sum > 0;
        L[i][j] = i == j ? Real(sqrt(sum)) : Real(sum / L[j][j]);
      }
    if (!runs) continue;
    IntegerMatrix columns(n, std::vector<Integer>(n));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j <= i; ++j) columns[j][i] = Integer(round(L[i][j]));
    IntegerMatrix squared(n, std::vector<Integer>(n));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        Integer sum = 0;
        for (std::size_t q = 0; q <= j; ++q) sum += columns[q][i] * columns[q][j];
        squared[i][j] = squared[j][i] = k * sum;
      }
    if (!std::ranges::all_of(all, [&](const IntegerMatrix& one) { return is_dominant(one, squared); })) continue;
    std::vector<std::string> items;  // columns from their diagonal entry on
    for (std::size_t j = 0; j < n; ++j)
      items.push_back(row_text({columns[j].begin() + std::ptrdiff_t(j), columns[j].end()}));
    return fmt::format("({}, {}%positive)", list_of(items), number_text(k));
  }
  return std::nullopt;
}

// With as few digits as suffice: Coq's time grows with their square.
std::optional<std::string> witness(const std::vector<IntegerMatrix>& all, int most) {
  for (const int fraction : {most / 2, most * 3 / 4, most})
    if (auto found = witness_of(all, fraction)) return found;
  return std::nullopt;
}

std::optional<std::string> coq_instance(const std::string& name, const dashpot_check::LoopForm& loop,
                                        const dashpot_check::Device& device, const StorageProof& proof,
                                        const Precision& precision, bool joins_holds) {
  const std::size_t n = loop.states.size();
  const std::vector<dashpot_check::Hold> holds = dashpot_check::holds(device);
  const bool lags = device.amplifier_lag > 0;
  // Of a late command ρ is what the tool moves until it acts, less the share of w that is so on an even way, rounded.
  const std::size_t columns = n + (device.write_latest > 0 ? 2 : 1);
  const Rational all = holds.back().before + holds.back().after;
  const Rational late = scaled(Rational(holds.back().after / all), 60) * power_of_two(-60);
  const std::size_t corners = lags ? 4 : 1;  // of each part of the holds
  const std::size_t lacking_at = 0;  // what an amplifier's lag keeps back, if anything: Coq's holds differ there
  std::vector<int> unit(n);
  std::map<std::string, std::size_t> place = {{"w", n}, {"late", n + 1}};
  for (std::size_t i = 0; i < n; ++i) place[loop.states[i]] = lags ? (i + 1) % n : i;
  RationalMatrix P(n, std::vector<Rational>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const std::size_t row = place.at(loop.states[i]), column = place.at(loop.states[j]);
      const std::vector<double>& stored = proof.storage[i];
      P[row][column] = P[column][row] = Rational(stored[j]) + (stored.size() > i + 1 ? stored[i + 1 + j] : 0);
    }
  const auto recursion = [&](const Rational& decay) {
    RationalMatrix A(n, std::vector<Rational>(columns));
    for (const std::string& next : loop.states)
      for (const auto& [state, value] : loop.next.at(next)) {
        const std::size_t row = place.at(next), column = place.at(state);
        const Rational factor = value * power_of_two((column < n ? unit[column] : 0) - unit[row]);
        A[row][column] += factor;
        if (column == n + 1) A[row][n] += factor * late;
      }
    if (lags) A[lacking_at][lacking_at] += decay;
    return A;
  };
  const auto answer = [&](const Rational& share) {
    RationalMatrix C(1, std::vector<Rational>(n));
    for (const auto& [state, value] : loop.force) C[0][place.at(state)] = value * power_of_two(unit[place.at(state)]);
    if (lags) C[0][lacking_at] += share * power_of_two(unit[lacking_at]);
    return C;
  };
  // States in units in which the longest hold leaves as much of each one's square as of that of w: few digits of the
  // witnesses are then enough.
  const double middle = Rational(Rational(proof.damping) / holds.back().before).convert_to<double>();
  const RationalMatrix of_longest = recursion(holds[holds.size() - corners].decay);
  for (std::size_t i = 0; i < n; ++i) {
    Rational left = P[i][i];
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t l = 0; l < n && of_longest[k][i] != 0; ++l)
        if (of_longest[l][i] != 0) left -= of_longest[k][i] * P[k][l] * of_longest[l][i];
    if (left > 0 && middle > 0) unit[i] = int(std::lround(std::log2(middle / left.convert_to<double>()) / 2));
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) P[i][j] *= power_of_two(unit[i] + unit[j]);
  RationalMatrix E(1, std::vector<Rational>(lags ? n : 0));
  if (lags) E[0][lacking_at] = power_of_two(unit[lacking_at]);
  unsigned A_digits = precision.kept, S_digits = std::max(digits_of(E), 200u);
  for (const dashpot_check::Hold& hold : holds) {
    A_digits = std::max(A_digits, digits_of(recursion(hold.decay)));
    S_digits = std::max(S_digits, digits_of(answer(hold.share)));
  }
  const unsigned P_digits = digits_of(P), dropped = A_digits - precision.kept;
  const Integer slack = Integer(1) << precision.slack;
  const IntegerMatrix stored = scaled(P, P_digits);
  const std::vector<Integer> lacking = lags ? scaled(E, S_digits)[0] : std::vector<Integer>(n);
  const Integer stiffness = scaled(loop.stiffness, S_digits);
  Integer magnitude = 0;  // of the entries of P
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) magnitude += abs(stored[i][j]);
  // β and γ of Loop.v. Of a late command b (w − c)²/A + b c²/D with c = ρ + s w, where what rounding s leaves of w ρ is
  // taken off both.
  const auto dissipation = [&](const dashpot_check::Hold& longest) {
    const Rational damping = proof.damping;
    if (longest.after > 0) {
      const Rational before = damping / longest.before, after = damping / longest.after, rest = 1 - late;
      const Rational both = abs(after * late - before * rest);
      return std::pair(scaled(Rational(before * rest * rest + after * late * late - both), S_digits),
                       scaled(Rational(before + after - both), S_digits));
    }
    return std::pair(scaled(Rational(damping / longest.before), S_digits),
                     lags ? scaled(Rational(damping / longest.spread), S_digits) : Integer(0));
  };
  // What goes in + V − V⁺ by the leading digits of A, less what the others may take: `near` of Loop.v.
  const auto balance = [&](const IntegerMatrix& whole, const std::vector<Integer>& C, const Integer& beta,
                           const Integer& gamma) {
    IntegerMatrix A = whole;
    for (std::vector<Integer>& row : A)
      for (Integer& value : row) value = without_last(value, dropped);
    const Integer s = slack << (2 * precision.kept), t = s << P_digits;
    const Integer more = (slack + 1) << (S_digits + 1);
    IntegerMatrix M(n + 2, std::vector<Integer>(n + 2)), PA(n, std::vector<Integer>(columns));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t j = 0; j < columns; ++j)
          if (A[k][j] != 0) PA[i][j] += stored[i][k] * A[k][j];
    for (std::size_t i = 0; i < columns; ++i)
      for (std::size_t j = 0; j < columns; ++j) {
        Integer sum = 0;
        for (std::size_t k = 0; k < n; ++k)
          if (A[k][i] != 0) sum += A[k][i] * PA[k][j];
        M[i][j] = -more * sum;
        if (i < n && j < n) M[i][j] += (s * stored[i][j]) << (S_digits + 1);
      }
    for (std::size_t i = 0; i < n; ++i) {
      M[i][n] += t * C[i], M[n][i] += t * C[i];
      M[i][n + 1] += t * lacking[i], M[n + 1][i] += t * lacking[i];
    }
    M[n][n] += t * (2 * beta - stiffness);
    M[n + 1][n + 1] += t * 2 * gamma;
    for (std::size_t i = 0; i < columns; ++i) M[i][i] -= more * slack * magnitude * columns;
    return M;
  };
  IntegerMatrix fine = stored;
  for (std::vector<Integer>& row : fine)
    for (Integer& value : row) value <<= S_digits;
  const std::optional<std::string> of_P = witness({fine}, precision.witness);
  // Of the holds from the shortest of part `from` to the longest of part `to`: by one witness for all corners, or for
  // those of each decay.
  const auto witnesses = [&](std::size_t from, std::size_t to) -> std::optional<std::string> {
    const dashpot_check::Hold& longest = holds[to * corners];
    const auto [beta, gamma] = dissipation(longest);
    std::vector<std::vector<IntegerMatrix>> groups(1);
    for (std::size_t corner = 0; corner < corners; ++corner) {
      if (corner == 2 && device.jitter > 0) groups.emplace_back();
      const Rational& decay = holds[corner < 2 ? to * corners : from * corners + 2].decay;
      const Rational& share = holds[to * corners + corner % 2].share;
      groups.back().push_back(
          balance(scaled(recursion(decay), A_digits), scaled(answer(share), S_digits)[0], beta, gamma));
    }
    std::vector<std::string> texts;
    for (const std::vector<IntegerMatrix>& group : groups)
      if (auto found = witness(group, precision.witness)) texts.push_back(std::move(*found));
      else return std::nullopt;
    return list_of(texts);
  };
  // Coq takes as long as there are parts: short holds, of which less is asked, are as many in one as have a witness.
  std::vector<std::string> part_texts, witness_texts;
  for (std::size_t from = 0, to = 0; from * corners < holds.size(); from = to + 1) {
    std::optional<std::string> found;
    for (to = joins_holds ? holds.size() / corners - 1 : from; !(found = witnesses(from, to)); --to)
      if (to == from) return std::nullopt;
    witness_texts.push_back(*found);
    const dashpot_check::Hold *first = &holds[to * corners], *last = &holds[from * corners + corners - 1];
    const auto [beta, gamma] = dissipation(*first);
    const auto A = [&](const dashpot_check::Hold& hold) {
      const Integer decay = scaled(recursion(hold.decay), A_digits)[lacking_at][lacking_at];
      return lags ? fmt::format("recursion ({})", number_text(decay)) : std::string("recursion");
    };
    const auto C = [&](const dashpot_check::Hold& hold) {
      const Integer share = scaled(answer(hold.share), S_digits)[0][lacking_at];
      return lags ? fmt::format("command ({})", number_text(share)) : std::string("command");
    };
    part_texts.push_back(
        fmt::format("{{| A1 := {}; A2 := {};\n     C1 := {}; C2 := {};\n     beta := {}; gamma := {} |}}", A(*first),
                    A(*last), C(*first), C(*(first + corners - 1)), number_text(beta), number_text(gamma)));
  }
  if (!of_P) return std::nullopt;
  const auto power = [](unsigned digits) { return number_text(Integer(1) << digits); };
  // A and C, behind a lag by the one entry of each in which holds differ.
  std::vector<std::string> A_rows, C_row = texts(scaled(answer(0), S_digits)[0]);
  for (const std::vector<Integer>& row : scaled(recursion(0), A_digits)) {
    std::vector<std::string> items = texts(row);
    if (lags && A_rows.size() == lacking_at) items[lacking_at] = "decay";
    A_rows.push_back(list_of(items));
  }
  if (lags) C_row[lacking_at] = "share";
  // Behind a lag the theorem is of the holds that there are, punctual or jittering; else of all shorter ones too.
  const std::string lengths = !lags               ? "up to "
                              : device.jitter > 0 ? fmt::format("{} to ", device.sample_period - device.jitter)
                                                  : "";
  return fmt::format(
      "(* '{}': whatever the tool does, no energy is taken out of the loop with {} N.s/m of damping (N.m.s/rad of a\n"
      "   rotation) at holds of {}{} s{}. Written by dashpot. In a copy of compiler/certify/proof, or of an\n"
      "   installation's share/dashpot/proof, with this file beside the others, coqc accepts it:\n"
      "     coqc -R . Dashpot Forms.v\n     coqc -R . Dashpot Loop.v\n     coqc -R . Dashpot THIS_FILE.v *)\n"
      "Require Import ZArith List Reals Forms Loop.\nImport ListNotations.\nLocal Open Scope Z_scope.\n\n"
      "Definition recursion{} : list (list Z) := {}.\nDefinition command{} : list Z := {}.\n"
      "Definition law : loop := {{|\n  states := {}; E := {}; k0 := {};\n  P := {};\n  eP := {}; eA := {}; eS := {};\n"
      "  parts := {} |}}.\nDefinition leading : digits := {{| kept := {}; dropped := {}; slack := {} |}}.\n"
      "Definition of_P : witness := {}.\nDefinition of_parts : list (list witness) := {}.\n\n"
      "Theorem law_is_sound : sound law.\n"
      "Proof. apply (sound_if_accepted law leading of_P of_parts). vm_cast_no_check (eq_refl true). Qed.\n"
      "Theorem nothing_is_extracted_from_this_law : forall holds, Forall (is_motion law) holds ->\n"
      "  (0 <= work law 0 (repeat 0 (states law)) holds)%R.\n"
      "Proof. exact (nothing_is_extracted law law_is_sound). Qed.\nPrint Assumptions "
      "nothing_is_extracted_from_this_law.\n",
      name, proof.damping, lengths, all.convert_to<double>(),
      columns > n + 1 ? ", each from when a\n   command acts until the next one does" : "", lags ? " (decay : Z)" : "",
      list_of(A_rows), lags ? " (share : Z)" : "", list_of(C_row), n, row_text(lags ? lacking : std::vector<Integer>{}),
      number_text(stiffness), form_text(stored), power(P_digits), power(A_digits), power(S_digits), list_of(part_texts),
      power(precision.kept), dropped, power(precision.slack), *of_P, list_of(witness_texts));
}

}  // namespace

std::optional<std::string> coq_instance(const std::string& name, const PassivityBound& bound,
                                        const std::optional<MotorConstants>& motor, SampledLoop loop,
                                        bool joins_holds) {
  const bool is_late_twice = loop.write_latest > 0 && loop.amplifier_lag > 0;  // there are then two inputs besides w
  if (!motor || bound.proof == Proof::none || loop.motor_slew > 0 || is_late_twice) return std::nullopt;
  const bool is_one_recursion =
      !adaptive_window_gain(loop) && loop.velocity.estimator != estimator_kind::interval_difference;
  if (motor->follows_estimate() && !is_one_recursion) return std::nullopt;  // the theorem is only for one recursion
  if (bound.constant_period_only) loop = punctual(loop);
  std::optional<StorageProof> proof;
  if (bound.storage) proof = {bound.needed, *bound.storage};
  else if (bound.proof == Proof::hold) proof = storage_proof(*motor, loop);
  if (!proof) return std::nullopt;
  const dashpot_check::Device device = checked_device(loop);
  const dashpot_check::LoopForm form = dashpot_check::loop_form(checked_program(*motor), device);
  for (const Precision& precision : {Precision{64, 40, 56}, Precision{112, 64, 72}, Precision{240, 120, 160}})
    if (auto instance = coq_instance(name, form, device, *proof, precision, joins_holds)) return instance;
  return std::nullopt;
}

}  // namespace dashpot::compiler
