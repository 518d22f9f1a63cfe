#include "commands/verify_texts.hpp"

#include <fmt/format.h>

#include "check/check.hpp"
#include "commands/verify_axes_texts.hpp"
#include "compile.hpp"
#include "emit/step_shape.hpp"
#include "linear/reach.hpp"
#include "source/errors_alone.hpp"
#include "source/excerpt.hpp"
#include "syntax/parse_axes.hpp"
#include "verify/compare_certificates.hpp"
#include "verify/compare_headers.hpp"
#include "verify/read_certificate.hpp"
#include "verify/verify_header.hpp"

namespace dashpot::compiler {
namespace {

bool is_of_many_points(const Network& network, const std::string& code) {
  return code.find(fmt::format("\nclass {}_batch {{\n", network.name)) != code.npos;
}

// What is written of the network: the header that decides by jumps and the one in constant time, where there is one; of
// one point or of many.
std::vector<std::string> emitted(const Compilation& compiled, bool of_many_points, Diagnostics& diagnostics) {
  std::vector<std::string> texts;
  for (const bool constant_time : {false, true}) {
    if (constant_time && !can_be_timed(compiled)) continue;
    EmissionOptions options;
    options.constant_time = constant_time;
    options.batch = of_many_points;
    if (auto files = emit_cpp(compiled, options, diagnostics))
      texts.push_back(std::move(files->at(of_many_points ? 1 : 0).text));
  }
  return texts;
}

class TextsVerification {
 public:
  TextsVerification(const SourceFile& certificate_file, const CertificateFile& certificate, SourceFiles& files,
                    Diagnostics& diagnostics)
      : certificate_file_(certificate_file),
        certificate_(certificate),
        files_(files),
        diagnostics_(diagnostics),
        network_file_(files.keep("network of the certificate", certificate.network_text)) {}

  // Whether network and device are what they should be.
  bool read_subject() {
    if (certificate_.device_text)
      device_ = read_device(files_.keep("device of the certificate", *certificate_.device_text), diagnostics_);
    network_ = with_errors_alone(diagnostics_, [&](Diagnostics& own) { return check(network_file_, own); });
    port_ = !network_ ? std::nullopt
            : device_ ? PortDevice::of(*device_, *network_, diagnostics_)
                      : PortDevice::ideal();
    if (!port_ || diagnostics_.has_errors()) {
      diagnostics_.report<DiagnosticCode::no_certificate>({}, certificate_file_.path(),
                                                          "its network or device is not read");
      return false;
    }
    return is_within_reach(*network_, diagnostics_, most_verified_nodes);
  }

  // How many constants are right; with errors where anything is not. Those of many points are of one, whose header is
  // written beside theirs.
  std::size_t verify(const SourceFile& header) {
    const bool of_many = is_of_many_points(*network_, header.text());
    if (of_many && !recompile()) return 0;
    const SourceFile& of_one =
        of_many ? files_.keep("header of one point", emitted(*compiled_, false, diagnostics_).at(0)) : header;
    const std::optional<HeaderConstants> constants = header_constants(of_one.text());
    if (!constants) {
      diagnostics_.report<DiagnosticCode::no_emitted_header>({}, of_one.path());
      return 0;
    }
    // What takes long is done last: many a wrong certificate is found out before.
    const bool is_linear = !beyond_linear(*network_);
    std::size_t count =
        is_linear ? verify_linear_constants(certificate_, *network_, *port_, *constants, diagnostics_) : 0;
    if (!recompile()) return 0;
    if (!is_linear) count = verify_constants(certificate_, *port_, *constants, *compiled_, diagnostics_);
    compare_headers(emitted(*compiled_, of_many, diagnostics_), header, diagnostics_);
    if (!diagnostics_.has_errors()) verify_bounds(certificate_, *port_, *constants, *compiled_, diagnostics_);
    if (!diagnostics_.has_errors()) {
      std::string again = certificate_text(*compiled_, certificate_.as_asked(), certificate_.network_text,
                                           certificate_.device_text, of_one.text());
      compare_certificates(certificate_file_, files_.keep("certificate written again", std::move(again)), diagnostics_);
    }
    if (!diagnostics_.has_errors() && is_linear && compiled_->certificate.bound.proof != Proof::none) check_apart();
    return count;
  }

  void tell_of_another_compile(const SourceFile& header) const {
    if (!compiled_) return;
    compiler::tell_of_another_compile(header, network_->name, device_ ? device_->name : "ideal", 1 / compiled_->rate,
                                      diagnostics_);
  }

  const Network& network() const { return *network_; }

  // Of what has been found right.
  std::string_view grade() const { return grade_of(compiled_->certificate); }
  // What is left open at the motor's limits, before the grade; empty where nothing is.
  std::string at_limits() const {
    const MotorLimits& limits = compiled_->certificate.limits;
    const std::string reason = why_not_covered(limits, port_units(network_->port_motion).damping);
    return limits.is_covered ? "" : "passivity at the motor's limits is not proved: " + reason + "; ";
  }
  std::string why_uncertified() const { return why_not_certified(compiled_->certificate, network_->port_motion); }

 private:
  // The bound, by code that shares nothing with the compiler, where that knows the law: in the form that decides by
  // jumps, of which the header has been found to be another one or itself. It does not know sums sample by sample,
  // which are what is stated of some laws behind an amplifier's lag under jitter.
  void check_apart() {
    const PassivityBound& bound = compiled_->certificate.bound;
    const SampledLoop& loop = compiled_->certificate.loop;
    const bool is_known = bound.proof == Proof::hold ? loop.amplifier_lag == 0 : bound.storage.has_value();
    if (loop.motor_slew > 0 || !is_known) return;
    const auto [status, words] =
        dashpot_check::verdict(emitted(*compiled_, false, diagnostics_).at(0), std::string(certificate_file_.text()));
    const bool is_proved = status == 0 || status == 4;  // 4: and less damping is there, as the certificate says itself
    if (!is_proved)
      diagnostics_.report<DiagnosticCode::certificate_disagrees>({}, "certificate", "independent check",
                                                                 excerpt(words));
  }

  bool recompile() {
    if (compiled_) return true;
    compiled_ = with_errors_alone(
        diagnostics_, [&](Diagnostics& own) { return compile(network_file_, certificate_.as_asked(), device_, own); });
    if (compiled_) return true;
    diagnostics_.report<DiagnosticCode::no_certificate>({}, network_file_.path(), "its network does not compile");
    return false;
  }

  const SourceFile& certificate_file_;
  const CertificateFile& certificate_;
  SourceFiles& files_;
  Diagnostics& diagnostics_;
  const SourceFile& network_file_;
  std::optional<Network> network_;
  std::optional<Device> device_;
  std::optional<PortDevice> port_;
  std::optional<Compilation> compiled_;
};

}  // namespace

std::optional<std::string> verify_texts(const SourceFile& certificate_file, const SourceFile& header,
                                        bool allow_uncertified, SourceFiles& files, Diagnostics& diagnostics) {
  if (axes_of(certificate_file) > 1)
    return verify_axes_texts(certificate_file, header, allow_uncertified, files, diagnostics);
  const std::optional<CertificateFile> certificate = read_certificate(certificate_file, diagnostics);
  if (!certificate) return std::nullopt;
  TextsVerification verification(certificate_file, *certificate, files, diagnostics);
  if (!verification.read_subject()) return std::nullopt;
  const std::size_t count = verification.verify(header);
  if (diagnostics.has_errors()) {
    verification.tell_of_another_compile(header);
    return std::nullopt;
  }
  if (!certificate->certified && !allow_uncertified) {
    diagnostics.report<DiagnosticCode::verified_uncertified>({}, verification.network().name,
                                                             verification.why_uncertified());
    diagnostics.note<DiagnosticCode::allow_uncertified>({});
    return std::nullopt;
  }
  return fmt::format(
      "{}: {} constants are correctly rounded, recomputed from the network in 100 digits; banner and code are those of "
      "the network; {}{}\n",
      verification.network().name, count, verification.at_limits(), verification.grade());
}

}  // namespace dashpot::compiler
