#include "fit/line_reader.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "fit/table_shape.hpp"
#include "source/utf8.hpp"

namespace dashpot::compiler::fitting {
namespace {

constexpr std::size_t piece = std::size_t{1} << 20;  // [bytes] that are read together

}  // namespace

LineReader::LineReader(std::string path, ReadProgress progress)
    : path_(std::move(path)), progress_(std::move(progress)) {}

LineReader::LineReader(std::string path, std::string text)
    : path_(std::move(path)), buffer_(std::move(text)), is_at_end_(true) {
  digest_.add(buffer_);
}

bool LineReader::open(Diagnostics& diagnostics) {
  if (!is_at_end_) {
    std::error_code error;
    const bool is_folder = std::filesystem::is_directory(path_, error);
    file_.reset(is_folder ? nullptr : std::fopen(path_.c_str(), "rb"));
    if (!file_) {
      const std::string why = is_folder ? "it is a folder" : std::strerror(errno);
      diagnostics.report<DiagnosticCode::cannot_read_file>({}, path_, why);
      has_failed_ = true;
      return false;
    }
    const std::uintmax_t size = std::filesystem::file_size(path_, error);
    size_ = error ? 0 : static_cast<std::size_t>(size);
    if (!fill(diagnostics)) return !has_failed_;
  }
  if (!is_text(buffer_)) {
    diagnostics.report<DiagnosticCode::recording_not_text>({}, path_);
    has_failed_ = true;
    return false;
  }
  if (buffer_.starts_with(byte_order_mark)) at_ = byte_order_mark.size();
  return true;
}

bool LineReader::fill(Diagnostics& diagnostics) {
  if (is_at_end_) return false;
  buffer_.erase(0, at_);
  at_ = 0;
  const std::size_t before = buffer_.size();
  buffer_.resize(before + piece);
  const std::size_t count = std::fread(buffer_.data() + before, 1, piece, file_.get());
  buffer_.resize(before + count);
  digest_.add(std::string_view(buffer_).substr(before));
  total_ += count;
  if (progress_) progress_(total_, size_);
  if (std::ferror(file_.get()) != 0) {
    diagnostics.report<DiagnosticCode::cannot_read_file>({}, path_, "reading failed");
    has_failed_ = is_at_end_ = true;
  } else if (total_ > largest_recording) {
    diagnostics.report<DiagnosticCode::file_too_large>({}, path_, largest_recording >> 20);
    has_failed_ = is_at_end_ = true;
  }
  if (count < piece) is_at_end_ = true;
  return count > 0 && !has_failed_;
}

std::optional<std::string_view> LineReader::next(Diagnostics& diagnostics) {
  if (has_failed_) return std::nullopt;
  std::size_t end = buffer_.find('\n', at_);
  while (end == std::string::npos && !is_at_end_) {
    if (buffer_.size() - at_ > longest_line) {
      diagnostics.report<DiagnosticCode::recording_line_too_long>({}, path_, number_ + 1, longest_line >> 20);
      has_failed_ = true;
      return std::nullopt;
    }
    if (!fill(diagnostics)) break;
    end = buffer_.find('\n', at_);
  }
  if (has_failed_ || (end == std::string::npos && at_ >= buffer_.size())) return std::nullopt;
  if (end == std::string::npos) end = buffer_.size();
  std::string_view line = std::string_view(buffer_).substr(at_, end - at_);
  if (line.ends_with('\r')) line.remove_suffix(1);
  at_ = std::min(end + 1, buffer_.size());
  ++number_;
  return line;
}

}  // namespace dashpot::compiler::fitting
