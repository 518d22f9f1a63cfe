#include "emit/write_files.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "emit/unfinished_files.hpp"

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

// What the system says where the text cannot be written; empty where all of it is.
std::string fault_in_writing(const fs::path& path, const std::string& text) {
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return std::strerror(errno);
  int fault = std::fwrite(text.data(), 1, text.size(), file) == text.size() ? 0 : errno;
  if (std::fclose(file) != 0 && fault == 0) fault = errno;
  return fault == 0 ? "" : std::strerror(fault);
}

std::string fault_in_making_folder(const fs::path& folder) {
  std::error_code error, ignored;
  if (folder.empty() || fs::is_directory(folder, ignored)) return "";
  fs::create_directories(folder, error);
  return error ? error.message() : "";
}

std::string fault_in_renaming(const Pending& file) {
  std::error_code error;
  fs::rename(file.beside, file.target, error);
  return error ? error.message() : "";
}

std::vector<std::string> names_beside(const std::vector<Pending>& files) {
  std::vector<std::string> names;
  for (const Pending& file : files)
    if (!file.beside.empty()) names.push_back(file.beside.string());
  return names;
}

// The folders that must be made for the files, innermost first.
std::vector<std::string> folders_to_make(const std::vector<Pending>& files) {
  std::vector<std::string> folders;
  std::error_code ignored;
  for (const Pending& file : files)
    for (fs::path folder = file.target.parent_path(); !folder.empty() && !fs::exists(folder, ignored);
         folder = folder.parent_path())
      folders.push_back(folder.string());
  return folders;
}

// In this order: what cannot be undone comes last.
enum class Stage { text_beside, text_into_pipes, renames };

std::string fault_of(const Pending& pending, const std::string& text, Stage stage) {
  const bool is_file = !pending.beside.empty();
  std::error_code ignored;
  switch (stage) {
    case Stage::text_beside:
      if (fs::is_directory(pending.target, ignored)) return std::strerror(EISDIR);
      if (const std::string fault = fault_in_making_folder(pending.target.parent_path()); !fault.empty()) return fault;
      return is_file ? fault_in_writing(pending.beside, text) : "";
    case Stage::text_into_pipes: return is_file ? "" : fault_in_writing(pending.target, text);
    case Stage::renames: return is_file ? fault_in_renaming(pending) : "";
  }
  return "";
}

}  // namespace

bool write_files(const std::string& folder, const std::vector<OutputFile>& files, Diagnostics& diagnostics) {
  std::vector<Pending> all;
  for (const OutputFile& file : files) all.push_back(pending(fs::path(folder) / file.name));
  const UnfinishedFiles unfinished(names_beside(all), folders_to_make(all));
  for (const Stage stage : {Stage::text_beside, Stage::text_into_pipes, Stage::renames})
    for (std::size_t i = 0; i < files.size(); ++i)
      if (const std::string fault = fault_of(all[i], files[i].text, stage); !fault.empty()) {
        diagnostics.report<DiagnosticCode::cannot_write_file>({}, (fs::path(folder) / files[i].name).string(), fault);
        return false;
      }
  return true;
}

}  // namespace dashpot::compiler
