#include "emit/write_files.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <system_error>

namespace dashpot::compiler {
namespace {

namespace fs = std::filesystem;

bool write_whole(const fs::path& path, const std::string& text) {
  std::ofstream stream(path, std::ios::binary | std::ios::trunc);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  return stream.good();
}

void remove_all(const std::vector<fs::path>& paths) {
  std::error_code ignored;
  for (const fs::path& path : paths) fs::remove(path, ignored);
}

}  // namespace

bool write_files(const std::string& folder, const std::vector<OutputFile>& files, Diagnostics& diagnostics) {
  std::error_code error;
  std::vector<fs::path> written;
  for (const OutputFile& file : files) {
    const fs::path target = fs::path(folder) / file.name;
    fs::create_directories(target.parent_path(), error);
    written.push_back(target.string() + ".new" + std::to_string(::getpid()));
    if (fs::is_directory(target) || !write_whole(written.back(), file.text)) {
      diagnostics.report<DiagnosticCode::cannot_write_file>({}, target.string(), "not a file that can be written");
      remove_all(written);
      return false;
    }
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    fs::rename(written[i], fs::path(folder) / files[i].name, error);
    if (!error) continue;
    diagnostics.report<DiagnosticCode::cannot_write_file>({}, (fs::path(folder) / files[i].name).string(), error.message());
    remove_all(written);
    return false;
  }
  return true;
}

}  // namespace dashpot::compiler
