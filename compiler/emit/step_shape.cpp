#include "emit/step_shape.hpp"

#include <fmt/format.h>

#include <string_view>

#include "law/cost.hpp"

namespace dashpot::compiler {
namespace {

std::size_t operations_of(const UpdateLaw& law) {
  return operations_of(cost_of(law, law.output)) + operations_of(cost_of(law, law.update));
}

// Names that the headers of C99, and some of POSIX, declare: in C the network's type has its name beside these,
// whatever else a program includes. `self` is the pointer to it.
constexpr std::string_view names_of_c =
    " FILE I abort abs access alarm asctime atexit atof atoi atol atoll bcmp bcopy bsearch btowc bzero calloc "
    "clearerr clock clock_t close complex ctime difftime div div_t double_t drem dup exit fclose feclearexcept "
    "fegetenv fegetexceptflag fegetround feholdexcept fenv_t feof feraiseexcept ferror fesetenv fesetexceptflag "
    "fesetround fetestexcept feupdateenv fexcept_t fflush ffs fgetc fgetpos fgets fgetwc fgetws finite float_t fopen "
    "fork fpos_t fprintf fputc fputs fputwc fputws fread free freopen fscanf fseek fsetpos ftell fwide fwprintf "
    "fwrite fwscanf gamma getc getchar getenv getline gets getwc getwchar gmtime imaginary imaxabs imaxdiv imaxdiv_t "
    "index int16_t int32_t int64_t int8_t int_fast16_t int_fast32_t int_fast64_t int_fast8_t int_least16_t "
    "int_least32_t int_least64_t int_least8_t intmax_t intptr_t isalnum isalpha isblank iscntrl isdigit isfinite "
    "isgraph isinf islower isnan isprint ispunct isspace isupper iswalnum iswalpha iswblank iswcntrl iswctype "
    "iswdigit iswgraph iswlower iswprint iswpunct iswspace iswupper iswxdigit isxdigit j0 j1 jmp_buf jn kill labs "
    "ldiv ldiv_t link llabs lldiv lldiv_t localeconv localtime lockf longjmp lseek main malloc max_align_t mblen "
    "mbrlen mbrtowc mbsinit mbsrtowcs mbstate_t mbstowcs mbtowc memchr memcmp memcpy memmove memset mktime nice "
    "offsetof open pause perror pipe poll printf ptrdiff_t putc putchar puts putwc putwchar qsort raise rand random "
    "read realloc remove rename restrict rewind rindex scalb scanf select self setbuf setjmp setlocale setvbuf "
    "sig_atomic_t signal significand size_t sleep snprintf sprintf srand srandom sscanf stderr stdin stdout strcat "
    "strchr strcmp strcoll strcpy strcspn strerror strftime strlen strncat strncmp strncpy strpbrk strrchr strspn "
    "strstr strtod strtof strtoimax strtok strtol strtold strtoll strtoul strtoull strtoumax strxfrm swab swprintf "
    "swscanf sync system time time_t tmpfile tmpnam tolower toupper towctrans towlower towupper uint16_t uint32_t "
    "uint64_t uint8_t uint_fast16_t uint_fast32_t uint_fast64_t uint_fast8_t uint_least16_t uint_least32_t "
    "uint_least64_t uint_least8_t uintmax_t uintptr_t ungetc ungetwc unlink usleep va_list vfprintf vfscanf "
    "vfwprintf vfwscanf vprintf vscanf vsnprintf vsprintf vsscanf vswprintf vswscanf vwprintf vwscanf wchar_t "
    "wcrtomb wcscat wcschr wcscmp wcscoll wcscpy wcscspn wcsftime wcslen wcsncat wcsncmp wcsncpy wcspbrk wcsrchr "
    "wcsrtombs wcsspn wcsstr wcstod wcstof wcstoimax wcstok wcstol wcstold wcstoll wcstombs wcstoul wcstoull "
    "wcstoumax wcsxfrm wctob wctomb wctrans wctrans_t wctype wctype_t wint_t wmemchr wmemcmp wmemcpy wmemmove "
    "wmemset wprintf write wscanf y0 y1 yn ";

// Functions that there are in double, in float with an 'f' behind the name, and in long double with an 'l'.
constexpr std::string_view functions_of_numbers =
    " acos acosh asin asinh atan atan2 atanh cabs cacos cacosh carg casin casinh catan catanh cbrt ccos ccosh "
    "ceil cexp cimag clog conj copysign cos cosh cpow cproj creal csin csinh csqrt ctan ctanh erf erfc exp exp2 "
    "expm1 fabs fdim floor fma fmax fmin fmod frexp hypot ilogb ldexp lgamma llrint llround log log10 log1p log2 "
    "logb lrint lround modf nan nearbyint nextafter nexttoward pow remainder remquo rint round scalbln scalbn "
    "sin sinh sqrt tan tanh tgamma trunc ";

bool is_word_of(std::string_view words, std::string_view name) {
  return words.find(fmt::format(" {} ", name)) != words.npos;
}

bool is_name_of_c(std::string_view name) {
  const bool has_form = name.ends_with('f') || name.ends_with('l');
  return is_word_of(names_of_c, name) || is_word_of(functions_of_numbers, name) ||
         (has_form && is_word_of(functions_of_numbers, name.substr(0, name.size() - 1)));
}

}  // namespace

bool can_be_timed(const Compilation& c) { return c.law.couplings.empty() && c.law.networks.empty(); }

bool can_be_timed(const Compilation& c, Diagnostics& diagnostics) {
  if (can_be_timed(c)) return true;
  diagnostics.report<DiagnosticCode::step_of_coupled_slips>(c.network.name_span, c.network.name);
  diagnostics.note<DiagnosticCode::bounded_step_remedy>({}, operations_of(c.law));
  return false;
}

bool can_be_c99(const std::string& name, const Span& name_span, Diagnostics& diagnostics) {
  const bool is_taken = is_name_of_c(name) || name.starts_with("dashpot_");
  if (is_taken) diagnostics.report<DiagnosticCode::name_is_word_of_c>(name_span, name);
  return !is_taken;
}

}  // namespace dashpot::compiler
