// Network text taken through the whole compiler, so that these tests hold whatever the stages pass to each other.
#pragma once

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include "compile.hpp"
#include "source/render.hpp"

namespace dashpot::compiler {

class Compiled {
 public:
  explicit Compiled(const std::string& text, const Choices& choices = {})
      : source_(std::make_unique<SourceFile>("test.json", text)),
        result_(compile(*source_, choices, std::nullopt, diagnostics_)) {
    if (!result_) throw std::invalid_argument(render_text(diagnostics_));
  }

  const Compilation* operator->() const { return &*result_; }
  const UpdateLaw& law() const { return result_->law; }

  bool reports(DiagnosticCode code) const {
    const std::vector<Diagnostic> all = diagnostics_.in_file_order();
    return std::any_of(all.begin(), all.end(), [code](const Diagnostic& d) { return d.code == code; });
  }

 private:
  std::unique_ptr<SourceFile> source_;
  Diagnostics diagnostics_;
  std::optional<Compilation> result_;
};

inline std::string network_text(const std::string& structure) {
  return "{ \"dashpot\": 1, \"name\": \"written\", \"network\": " + structure + " }";
}

}  // namespace dashpot::compiler
