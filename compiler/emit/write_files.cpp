#include "emit/write_files.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <system_error>

namespace dashpot::compiler {
namespace {

namespace fs = std::filesystem;

// Where the text goes: a link stays a link, and what it leads to is replaced.
fs::path behind_links(const fs::path& path) {
  std::error_code error;
  const fs::path target = fs::is_symlink(path, error) ? fs::weakly_canonical(path, error) : path;
  return error ? path : target;
}

struct Pending {
  fs::path target;
  fs::path beside;  // written first, then renamed; empty for a pipe or a device, which is written into
};

Pending pending(const fs::path& path) {
  const fs::path target = behind_links(path);
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) return {target, {}};
  return {target, target.string() + ".new" + std::to_string(::getpid())};
}

bool write_whole(const fs::path& path, const std::string& text) {
  std::ofstream stream(path, std::ios::binary | std::ios::trunc);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  return stream.good();
}

void remove_all(const std::vector<Pending>& files) {
  std::error_code ignored;
  for (const Pending& file : files)
    if (!file.beside.empty()) fs::remove(file.beside, ignored);
}

std::string fault_of(bool is_done) { return is_done ? "" : "not a file that can be written"; }

std::string put_in_place(const Pending& file, const std::string& text) {
  if (file.beside.empty()) return fault_of(write_whole(file.target, text));
  std::error_code error;
  fs::rename(file.beside, file.target, error);
  return error ? error.message() : "";
}

}  // namespace

bool write_files(const std::string& folder, const std::vector<OutputFile>& files, Diagnostics& diagnostics) {
  std::vector<Pending> written;
  const auto fail = [&](const fs::path& path, const std::string& fault) {
    diagnostics.report<DiagnosticCode::cannot_write_file>({}, path.string(), fault);
    remove_all(written);
    return false;
  };
  for (const OutputFile& file : files) {
    const fs::path path = fs::path(folder) / file.name;
    std::error_code ignored;
    fs::create_directories(path.parent_path(), ignored);
    written.push_back(pending(path));
    if (fs::is_directory(path, ignored)) return fail(path, fault_of(false));
    if (!written.back().beside.empty() && !write_whole(written.back().beside, file.text)) return fail(path, fault_of(false));
  }
  for (std::size_t i = 0; i < files.size(); ++i)
    if (const std::string fault = put_in_place(written[i], files[i].text); !fault.empty())
      return fail(fs::path(folder) / files[i].name, fault);
  return true;
}

}  // namespace dashpot::compiler
