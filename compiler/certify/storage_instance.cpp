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

// Binary digits that Coq computes with: of A, of the share of V that pays for the others, and of witnesses, which have
// no more than Real.
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

// Rounded down, as Z.shiftr does.
Integer without_last(const Integer& value, unsigned digits) {
  if (value >= 0) return value >> digits;
  return -((-value + (Integer(1) << digits) - 1) >> digits);
}

Rational power_of_two(int exponent) {
  return exponent >= 0 ? Rational(Integer(1) << exponent) : Rational(1, Integer(1) << -exponent);
}

// Columns of L and k with M − k L Lᵀ diagonally dominant, tried with smaller and smaller margins.
std::optional<std::string> witness(const IntegerMatrix& M, int fraction) {
  const std::size_t n = M.size();
  Integer largest = 0;
  for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, M[i][i]);
  if (largest == 0) return "([], 1%positive)";
  const int exponent = std::max(0, int(msb(largest)) / 2 - fraction);
  const Integer k = Integer(1) << (2 * exponent);
  std::vector<std::vector<Real>> unit(n, std::vector<Real>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) unit[i][j] = Real(M[i][j]) / Real(k);
  for (int margin = 20; margin <= 120; margin += 4) {
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
    bool dominant = true;
    for (std::size_t i = 0; i < n && dominant; ++i) {
      Integer off = 0, own = 0;
      for (std::size_t j = 0; j < n; ++j) {
        Integer rest = M[i][j];
        for (std::size_t q = 0; q < n; ++q) rest -= k * columns[q][i] * columns[q][j];
        (i == j ? own : off) += i == j ? rest : abs(rest);
      }
      dominant = own >= off;
    }
    if (!dominant) continue;
    std::vector<std::string> items;  // columns from their diagonal entry on
    for (std::size_t j = 0; j < n; ++j)
      items.push_back(row_text({columns[j].begin() + std::ptrdiff_t(j), columns[j].end()}));
    return fmt::format("({}, {}%positive)", list_of(items), number_text(k));
  }
  return std::nullopt;
}

}  // namespace

namespace {

std::optional<std::string> coq_instance(const std::string& name, const dashpot_check::LoopForm& loop,
                                        const dashpot_check::Device& device, const StorageProof& proof,
                                        const Precision& precision) {
  const std::size_t n = loop.states.size();
  const std::vector<dashpot_check::Hold> holds = dashpot_check::holds(device);
  const bool lags = device.amplifier_lag > 0;
  const std::size_t corners = lags ? 4 : 1;  // of each part of the holds
  const Rational stiffest = Rational(proof.damping) / holds.back().longest;
  // States in units in which P has a diagonal like that of b/T.
  std::vector<int> unit(n);
  const double middle = stiffest.convert_to<double>();
  for (std::size_t i = 0; i < n; ++i) {
    const double own = proof.storage[i][i];
    unit[i] = own > 0 && middle > 0 ? int(std::lround(std::log2(middle / own) / 2)) : 0;
  }
  RationalMatrix P(n, std::vector<Rational>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      P[i][j] = P[j][i] = Rational(proof.storage[i][j]) * power_of_two(unit[i] + unit[j]);
  std::map<std::string, std::size_t> place = {{"w", n}};
  for (std::size_t i = 0; i < n; ++i) place[loop.states[i]] = i;
  const auto recursion = [&](const Rational& decay) {
    RationalMatrix A(n, std::vector<Rational>(n + 1));
    for (std::size_t i = 0; i < n; ++i)
      for (const auto& [state, value] : loop.next.at(loop.states[i]))
        A[i][place.at(state)] = value * power_of_two((place.at(state) < n ? unit[place.at(state)] : 0) - unit[i]);
    if (lags) A[n - 1][n - 1] += decay;
    return A;
  };
  const auto answer = [&](const Rational& share) {
    RationalMatrix C(1, std::vector<Rational>(n));
    for (const auto& [state, value] : loop.force) C[0][place.at(state)] = value * power_of_two(unit[place.at(state)]);
    if (lags) C[0][n - 1] += share * power_of_two(unit[n - 1]);
    return C;
  };
  RationalMatrix E(1, std::vector<Rational>(lags ? n : 0));
  if (lags) E[0][n - 1] = power_of_two(unit[n - 1]);
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
  Integer magnitude = 0;  // of all of P
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) magnitude += abs(stored[i][j]);
  // What goes in + V − V⁺ by the leading digits of A, less what the others may take: `near` of Loop.v.
  const auto balance = [&](const IntegerMatrix& whole, const std::vector<Integer>& C, const Integer& beta,
                           const Integer& gamma) {
    IntegerMatrix A = whole;
    for (std::vector<Integer>& row : A)
      for (Integer& value : row) value = without_last(value, dropped);
    const Integer s = slack << (2 * precision.kept), t = s << P_digits;
    const Integer more = (slack + 1) << (S_digits + 1);
    IntegerMatrix M(n + 2, std::vector<Integer>(n + 2)), PA(n, std::vector<Integer>(n + 1));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t j = 0; j <= n; ++j)
          if (A[k][j] != 0) PA[i][j] += stored[i][k] * A[k][j];
    for (std::size_t i = 0; i <= n; ++i)
      for (std::size_t j = 0; j <= n; ++j) {
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
    for (std::size_t i = 0; i <= n; ++i) M[i][i] -= more * slack * magnitude * (n + 1);
    return M;
  };
  IntegerMatrix fine = stored;
  for (std::vector<Integer>& row : fine)
    for (Integer& value : row) value <<= S_digits;
  const std::optional<std::string> of_P = witness(fine, precision.witness);
  std::vector<std::string> part_texts, witness_texts;
  for (std::size_t part = 0; part < holds.size(); part += corners) {
    const dashpot_check::Hold &first = holds[part], &last = holds[part + corners - 1];
    const Integer beta = scaled(Rational(proof.damping) / first.longest, S_digits);
    const Integer gamma = lags ? scaled(Rational(proof.damping) / first.longest / first.spread, S_digits) : Integer(0);
    std::vector<std::string> witnesses;
    for (std::size_t corner = part; corner < part + corners; ++corner) {
      const auto found = witness(balance(scaled(recursion(holds[corner].decay), A_digits),
                                         scaled(answer(holds[corner].share), S_digits)[0], beta, gamma),
                                 precision.witness);
      if (!found) return std::nullopt;
      witnesses.push_back(*found);
    }
    witness_texts.push_back(list_of(witnesses));
    const auto of = [&](const dashpot_check::Hold& hold) {
      return lags ? std::pair{fmt::format("recursion ({})",
                                          number_text(scaled(recursion(hold.decay), A_digits)[n - 1][n - 1])),
                              fmt::format("command ({})", number_text(scaled(answer(hold.share), S_digits)[0][n - 1]))}
                  : std::pair{std::string("recursion"), std::string("command")};
    };
    part_texts.push_back(fmt::format(
        "{{| A1 := {}; A2 := {};\n     C1 := {}; C2 := {};\n     beta := {}; gamma := {} |}}", of(first).first,
        of(last).first, of(first).second, of(last).second, number_text(beta), number_text(gamma)));
  }
  if (!of_P) return std::nullopt;
  const auto power = [](unsigned digits) { return number_text(Integer(1) << digits); };
  // A and C, behind a lag by the one entry of each in which holds differ.
  std::vector<std::string> A_rows, C_row = texts(scaled(answer(0), S_digits)[0]);
  for (const std::vector<Integer>& row : scaled(recursion(0), A_digits)) {
    std::vector<std::string> items = texts(row);
    if (lags && A_rows.size() + 1 == n) items[n - 1] = "decay";
    A_rows.push_back(list_of(items));
  }
  if (lags) C_row[n - 1] = "share";
  // Behind a lag the theorem is of the holds that there are, punctual or jittering; else of all shorter ones too.
  const std::string lengths = !lags               ? "up to "
                              : device.jitter > 0 ? fmt::format("{} to ", device.sample_period - device.jitter)
                                                  : "";
  return fmt::format(
      "(* '{}': whatever the tool does, no energy is taken out of the loop with {} N.s/m of damping (N.m.s/rad of a\n"
      "   rotation) at holds of {}{} s. Written by dashpot. In a copy of compiler/certify/proof, or of an\n"
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
      name, proof.damping, lengths, holds.back().longest.convert_to<double>(), lags ? " (decay : Z)" : "",
      list_of(A_rows), lags ? " (share : Z)" : "", list_of(C_row), n, row_text(lags ? lacking : std::vector<Integer>{}),
      number_text(stiffness), form_text(stored), power(P_digits), power(A_digits), power(S_digits), list_of(part_texts),
      power(precision.kept), dropped, power(precision.slack), *of_P, list_of(witness_texts));
}

}  // namespace

std::optional<std::string> coq_instance(const std::string& name, const PassivityBound& bound,
                                        const std::optional<MotorConstants>& motor, SampledLoop loop) {
  if (!motor || bound.proof == Proof::none || loop.motor_slew > 0) return std::nullopt;
  const bool is_one_recursion =
      !adaptive_window_gain(loop) && loop.velocity.estimator != estimator_kind::interval_difference;
  if (motor->follows_estimate() && !is_one_recursion) return std::nullopt;  // of which the theorem is
  if (bound.constant_period_only) loop.jitter = 0;
  std::optional<StorageProof> proof;
  if (bound.storage) proof = {bound.needed, *bound.storage};
  else if (bound.proof == Proof::hold) proof = storage_proof(*motor, loop);
  if (!proof) return std::nullopt;
  const dashpot_check::Device device = checked_device(loop);
  const dashpot_check::LoopForm form = dashpot_check::loop_form(checked_program(*motor), device);
  for (const Precision& precision : {Precision{80, 48, 56}, Precision{112, 64, 72}, Precision{240, 120, 160}})
    if (auto instance = coq_instance(name, form, device, *proof, precision)) return instance;
  return std::nullopt;
}

}  // namespace dashpot::compiler
