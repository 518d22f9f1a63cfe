#include "commands/verify_axes_texts.hpp"

#include <fmt/format.h>

#include "compile_axes.hpp"
#include "linear/reach.hpp"
#include "source/errors_alone.hpp"
#include "verify/compare_certificates.hpp"
#include "verify/compare_headers.hpp"
#include "verify/read_certificate.hpp"
#include "verify/verify_axes.hpp"
#include "verify/verify_header.hpp"

namespace dashpot::compiler {
namespace {

// Network and device of a certificate, compiled again; nothing, reported, where they are none.
std::optional<AxesCompilation> recompiled(const SourceFile& file, const AxesCertificateFile& certificate,
                                          SourceFiles& files, Diagnostics& diagnostics) {
  const auto no_certificate = [&] {
    diagnostics.report<DiagnosticCode::no_certificate>({}, file.path(), "its network or device is not read");
  };
  const SourceFile& network = files.keep("network of the certificate", certificate.network_text);
  std::optional<AxesDevice> device;
  if (certificate.device_text) {
    device = read_axes_device(files.keep("device of the certificate", *certificate.device_text), diagnostics);
    if (!device) return no_certificate(), std::nullopt;
  }
  StageTimes unseen;
  std::optional<AxesCompilation> compiled = with_errors_alone(
      diagnostics, [&](Diagnostics& own) { return compile_axes(network, certificate.choices, device, own, unseen); });
  if (!compiled) return no_certificate(), std::nullopt;
  for (const Compilation& port : compiled->ports)
    if (!is_within_reach(port.network, diagnostics, most_verified_nodes)) return std::nullopt;
  return compiled;
}

std::string share_text(const AxesCompilation& c, const AxesCertificateFile& certificate, const NeedAtPlaces& there) {
  const Reference share =
      100 * there.most / Reference(certificate.needed_damping - certificate.for_estimates - certificate.for_lag);
  return fmt::format(
      "of the bound over the workspace on what the held forces need, {:.3g} % are needed at the worst of {} places, "
      "computed in 100 digits; ",
      c.certificate.needed > 0 ? share.convert_to<double>() : 0.0, there.places);
}

}  // namespace

std::optional<std::string> verify_axes_texts(const SourceFile& certificate_file, const SourceFile& header,
                                             bool allow_uncertified, SourceFiles& files, Diagnostics& diagnostics) {
  const std::optional<AxesCertificateFile> certificate = read_axes_certificate(certificate_file, diagnostics);
  if (!certificate) return std::nullopt;
  const std::optional<HeaderConstants> constants = header_constants(header.text());
  if (!constants) {
    diagnostics.report<DiagnosticCode::no_emitted_header>({}, header.path());
    return std::nullopt;
  }
  const auto compiled = recompiled(certificate_file, *certificate, files, diagnostics);
  if (!compiled) return std::nullopt;
  const std::size_t count = verify_axes_constants(*certificate, *constants, *compiled, diagnostics);
  const auto written = emit_axes_cpp(*compiled, {}, diagnostics);
  if (written) compare_headers({written->front().text}, header, diagnostics);
  const std::optional<NeedAtPlaces> there = verify_axes_bounds(*certificate, *compiled, diagnostics);
  if (!diagnostics.has_errors()) {
    std::string again =
        axes_certificate_text(*compiled, certificate->network_text, certificate->device_text, header.text());
    compare_certificates(certificate_file, files.keep("certificate written again", std::move(again)), diagnostics);
  }
  if (diagnostics.has_errors()) {
    tell_of_another_compile(header, compiled->network.name, compiled->has_device ? compiled->device.name : "ideal",
                            1 / compiled->rate, diagnostics);
    return std::nullopt;
  }
  const AxesCertificate& proved = compiled->certificate;
  const std::string why_not = why_not_certified(proved, compiled->device);
  if (!proved.certified && !allow_uncertified) {
    diagnostics.report<DiagnosticCode::verified_uncertified>({}, compiled->network.name, why_not);
    diagnostics.note<DiagnosticCode::allow_uncertified>({});
    return std::nullopt;
  }
  return fmt::format(
      "{}: {} constants are correctly rounded, recomputed from network and device in 100 digits; banner "
      "and code are those of the network; {}{}\n",
      compiled->network.name, count, there ? share_text(*compiled, *certificate, *there) : "",
      proved.certified ? "certified" : "not certified: " + why_not);
}

}  // namespace dashpot::compiler
