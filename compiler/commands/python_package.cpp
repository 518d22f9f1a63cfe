#include "commands/python_package.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "commands/system_compiler.hpp"
#include "emit/banner.hpp"
#include "emit/template_text.hpp"

namespace dashpot::compiler {
namespace {

// Words of Python 3, and modules of its library and beside it: a folder so called, on the path of a program, is what
// the others that import such a module find.
constexpr std::string_view words_of_python[] = {"False",        "None",
                                                "True",         "abc",
                                                "aifc",         "and",
                                                "antigravity",  "argparse",
                                                "array",        "as",
                                                "assert",       "ast",
                                                "async",        "asynchat",
                                                "asyncio",      "asyncore",
                                                "atexit",       "audioop",
                                                "await",        "base64",
                                                "bdb",          "binascii",
                                                "bisect",       "break",
                                                "builtins",     "bz2",
                                                "cProfile",     "calendar",
                                                "case",         "cgi",
                                                "cgitb",        "chunk",
                                                "class",        "cmath",
                                                "cmd",          "code",
                                                "codecs",       "codeop",
                                                "collections",  "colorsys",
                                                "compileall",   "concurrent",
                                                "configparser", "contextlib",
                                                "contextvars",  "continue",
                                                "copy",         "copyreg",
                                                "crypt",        "csv",
                                                "ctypes",       "curses",
                                                "dashpot",      "dataclasses",
                                                "datetime",     "dbm",
                                                "decimal",      "def",
                                                "del",          "difflib",
                                                "dis",          "distutils",
                                                "doctest",      "elif",
                                                "else",         "email",
                                                "encodings",    "ensurepip",
                                                "enum",         "errno",
                                                "except",       "faulthandler",
                                                "fcntl",        "filecmp",
                                                "fileinput",    "finally",
                                                "fnmatch",      "for",
                                                "fractions",    "from",
                                                "ftplib",       "functools",
                                                "gc",           "genericpath",
                                                "getopt",       "getpass",
                                                "gettext",      "glob",
                                                "global",       "graphlib",
                                                "grp",          "gzip",
                                                "hashlib",      "heapq",
                                                "hmac",         "html",
                                                "http",         "idlelib",
                                                "if",           "imaplib",
                                                "imghdr",       "imp",
                                                "import",       "importlib",
                                                "in",           "inspect",
                                                "io",           "ipaddress",
                                                "is",           "itertools",
                                                "json",         "keyword",
                                                "lambda",       "lib2to3",
                                                "linecache",    "locale",
                                                "logging",      "lzma",
                                                "mailbox",      "mailcap",
                                                "marshal",      "match",
                                                "math",         "matplotlib",
                                                "mimetypes",    "mmap",
                                                "modulefinder", "msilib",
                                                "msvcrt",       "multiprocessing",
                                                "netrc",        "nis",
                                                "nntplib",      "nonlocal",
                                                "not",          "nt",
                                                "ntpath",       "nturl2path",
                                                "numbers",      "numpy",
                                                "opcode",       "operator",
                                                "optparse",     "or",
                                                "os",           "ossaudiodev",
                                                "pass",         "pathlib",
                                                "pdb",          "pickle",
                                                "pickletools",  "pipes",
                                                "pkgutil",      "platform",
                                                "plistlib",     "poplib",
                                                "posix",        "posixpath",
                                                "pprint",       "profile",
                                                "pstats",       "pty",
                                                "pwd",          "py_compile",
                                                "pyclbr",       "pydoc",
                                                "pydoc_data",   "pyexpat",
                                                "queue",        "quopri",
                                                "raise",        "random",
                                                "re",           "readline",
                                                "reprlib",      "resource",
                                                "return",       "rlcompleter",
                                                "runpy",        "sched",
                                                "scipy",        "secrets",
                                                "select",       "selectors",
                                                "shelve",       "shlex",
                                                "shutil",       "signal",
                                                "site",         "smtpd",
                                                "smtplib",      "sndhdr",
                                                "socket",       "socketserver",
                                                "spwd",         "sqlite3",
                                                "sre_compile",  "sre_constants",
                                                "sre_parse",    "ssl",
                                                "stat",         "statistics",
                                                "string",       "stringprep",
                                                "struct",       "subprocess",
                                                "sunau",        "symtable",
                                                "sys",          "sysconfig",
                                                "syslog",       "tabnanny",
                                                "tarfile",      "telnetlib",
                                                "tempfile",     "termios",
                                                "textwrap",     "this",
                                                "threading",    "time",
                                                "timeit",       "tkinter",
                                                "token",        "tokenize",
                                                "tomllib",      "trace",
                                                "traceback",    "tracemalloc",
                                                "try",          "tty",
                                                "turtle",       "turtledemo",
                                                "types",        "typing",
                                                "unicodedata",  "unittest",
                                                "urllib",       "uu",
                                                "uuid",         "venv",
                                                "warnings",     "wave",
                                                "weakref",      "webbrowser",
                                                "while",        "winreg",
                                                "winsound",     "with",
                                                "wsgiref",      "xdrlib",
                                                "xml",          "xmlrpc",
                                                "yield",        "zipapp",
                                                "zipfile",      "zipimport",
                                                "zlib",         "zoneinfo"};

bool is_word_of_python(const std::string& name) {
  return std::find(std::begin(words_of_python), std::end(words_of_python), name) != std::end(words_of_python);
}

// The words that make law.so of law.c; the package says them where it is on another machine. Packing the few numbers of
// a state into vectors, to store them at once, costs more than it saves.
std::vector<std::string> words_of_compiler(const std::string& compiler) {
  return {compiler,  "-std=c99",           "-O2", "-ffp-contract=off", "-fno-tree-slp-vectorize", "-fPIC",
          "-shared", "-fvisibility=hidden"};
}

Fields described(const Compilation& c, std::initializer_list<const char*> names) {
  Fields all, wanted;
  describe_file(c, all);
  std::string build;
  for (const std::string& word : words_of_compiler("cc")) build += word + " ";
  all["build"] = build + "law.c -o law.so";
  all["rate"] = fmt::format("{:#}", c.rate);
  for (const char* name : names) wanted[name] = all.at(name);
  return wanted;
}

std::optional<std::string> library_of(const std::vector<OutputFile>& sources, Diagnostics& diagnostics) {
  const TemporaryFolder folder;
  if (!has_sources(folder, sources, diagnostics) ||
      !makes_library(words_of_compiler(environment_or("CC", "cc")), folder, "law.c", "law.so", diagnostics))
    return std::nullopt;
  return contents_of(folder.path() / "law.so");
}

}  // namespace

std::optional<std::vector<OutputFile>> emit_python(const Compilation& compilation, const EmissionOptions& options,
                                                   Diagnostics& diagnostics) {
  const std::string& name = compilation.network.name;
  if (is_word_of_python(name)) {
    diagnostics.report<DiagnosticCode::name_is_word_of_python>(compilation.network.name_span, name);
    return std::nullopt;
  }
  std::optional<std::vector<OutputFile>> files = emit_c99(compilation, options, diagnostics);
  if (!files) return std::nullopt;
  std::optional<std::string> law = filled("python_law.c.in", {described(compilation, {"name", "scalar", "rate"}), {}},
                                          options.templates, diagnostics);
  std::optional<std::string> package =
      filled("python_package.py.in",
             {described(compilation, {"build", "digest", "motion", "name", "rate", "scalar", "title", "version"}), {}},
             options.templates, diagnostics);
  if (!law || !package) return std::nullopt;
  files->push_back({"law.c", std::move(*law)});
  std::optional<std::string> library = library_of(*files, diagnostics);
  if (!library) return std::nullopt;
  files->push_back({"law.so", std::move(*library)});
  files->push_back({"explain.json", options.explanation});
  files->push_back({"__init__.py", std::move(*package)});
  for (OutputFile& file : *files) file.name = name + "/" + file.name;
  return files;
}

}  // namespace dashpot::compiler
