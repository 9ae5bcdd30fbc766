#include "mms/equations/reserved_words.hpp"

namespace tvbeam {

namespace {

/// The words of a text.
std::set<std::string> words(const char* text) {
    std::set<std::string> result;
    std::string word;
    for (const char* c = text;; ++c) {
        if (*c != ' ' && *c != '\0') {
            word += *c;
            continue;
        }
        result.insert(word);
        word.clear();
        if (*c == '\0')
            return result;
    }
}

constexpr const char* words_of_c =
    "auto break case char const continue default do double else enum extern float for goto if "
    "inline int long main register restrict return short signed sizeof static struct switch "
    "typedef typeof union unsigned void volatile while asm abs signgam lgamma_r lgammaf_r "
    "lgammal_r float_t double_t alignas alignof bool constexpr false nullptr static_assert "
    "thread_local true typeof_unqual values exit index rindex";
/// Functions of math.h, which also have an f and an l behind their names.
constexpr const char* functions_of_c =
    "acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh drem erf erfc exp exp2 "
    "expm1 fabs fdim finite floor fma fmax fmin fmod frexp gamma hypot ilogb isinf isnan j0 j1 jn "
    "ldexp lgamma llrint llround log log10 log1p log2 logb lrint lround modf nan nearbyint "
    "nextafter nexttoward pow remainder remquo rint round scalb scalbln scalbn significand sin "
    "sinh sqrt tan tanh tgamma trunc y0 y1 yn "
    // of C23, POSIX and GNU
    "canonicalize daddl ddivl dmull dsqrtl dsubl exp10 exp10m1 exp2m1 compoundn fadd fdiv ffma "
    "fmaximum fmaximum_mag fmaximum_mag_num fmaximum_num fmaxmag fminimum fminimum_mag "
    "fminimum_mag_num fminimum_num fminmag fmul fromfp fromfpx fsqrt fsub getpayload iscanonical "
    "iseqsig issignaling iszero issubnormal llogb log10p1 log2p1 logp1 nextdown nextup pown powr "
    "rootn roundeven rsqrt setpayload setpayloadsig sincos sinpi cospi tanpi asinpi acospi atanpi "
    "atan2pi totalorder totalordermag ufromfp ufromfpx";
/// Macros of math.h, of what C++ includes with it, and of the compilers.
constexpr const char* macros_of_c =
    "NAN INFINITY NULL HUGE_VAL HUGE_VALF HUGE_VALL FP_NAN FP_INFINITE FP_ZERO FP_SUBNORMAL "
    "FP_NORMAL FP_ILOGB0 FP_ILOGBNAN MATH_ERRNO MATH_ERREXCEPT math_errhandling MAXFLOAT SNAN "
    "SNANF SNANL RAND_MAX EXIT_SUCCESS EXIT_FAILURE BYTE_ORDER BIG_ENDIAN LITTLE_ENDIAN "
    "PDP_ENDIAN isless islessgreater islessequal isnormal issubnormal fpclassify isgreater "
    "isgreaterequal isfinite signbit isunordered alloca linux unix i386 "
    "FD_CLR FD_ISSET FD_SET FD_SETSIZE FD_ZERO NFDBITS MB_CUR_MAX WCONTINUED WEXITED WEXITSTATUS "
    "WIFCONTINUED WIFEXITED WIFSIGNALED WIFSTOPPED WNOHANG WNOWAIT WSTOPPED WSTOPSIG WTERMSIG "
    "WUNTRACED FP_INT_DOWNWARD FP_INT_TONEAREST FP_INT_TONEARESTFROMZERO FP_INT_TOWARDZERO "
    "FP_INT_UPWARD FP_LLOGB0 FP_LLOGBNAN HUGE_VAL_F32 HUGE_VAL_F64 HUGE_VAL_F128 HUGE_VAL_F32X "
    "HUGE_VAL_F64X SNANF32 SNANF64 SNANF128 SNANF32X SNANF64X be16toh be32toh be64toh htobe16 "
    "htobe32 htobe64 htole16 htole32 htole64 le16toh le32toh le64toh";
/// Other functions at global scope where C++ includes <cmath>.
constexpr const char* other_functions_of_c =
    "a64l abort abs aligned_alloc alloca arc4random at_quick_exit atexit atof atoi atol atoll "
    "bsearch calloc clearenv clone div drand48 ecvt epsilon erand48 exit fcvt free gcvt "
    "getloadavg getpt getsubopt getenv grantpt initstate jrand48 l64a labs lcong48 ldiv llabs "
    "lldiv lrand48 malloc mblen mbstowcs mbtowc mkdtemp mkostemp mkstemp mktemp mrand48 nrand48 "
    "on_exit pselect ptsname putenv qecvt qfcvt qgcvt qsort quick_exit rand random realloc "
    "reallocarray realpath rpmatch secure_getenv seed48 select setenv setstate srand srand48 "
    "srandom std strtod strtof strtol strtold strtoll strtoul strtoull strfromd strfromf strtoq "
    "strtouq system uint ulong unlockpt unsetenv ushort valloc wcstombs wctomb zeta "
    // types
    "blkcnt_t blksize_t caddr_t clock_t clockid_t daddr_t dev_t div_t fd_mask fd_set gid_t id_t "
    "ino_t int16_t int32_t int64_t int8_t key_t ldiv_t lldiv_t locale_t mode_t nlink_t off_t pid_t "
    "pthread_t quad_t register_t sigset_t size_t ssize_t suseconds_t time_t timer_t timespec "
    "timeval u_char u_int u_long u_short uid_t useconds_t max_align_t ptrdiff_t";
constexpr const char* words_of_cpp =
    "alignas alignof and bitand bitor bool break case catch char class compl concept const "
    "constexpr continue decltype default delete do double else enum explicit export extern false "
    "float for friend goto if inline int long mutable namespace new noexcept not nullptr operator "
    "or private protected public register requires return short signed sizeof static std struct "
    "switch template this throw true try typedef typeid typename union unsigned using virtual void "
    "volatile while xor asm auto typeof wchar_t char8_t char16_t char32_t float_t double_t and_eq "
    "or_eq xor_eq not_eq static_cast const_cast dynamic_cast reinterpret_cast static_assert "
    "thread_local co_await co_return co_yield consteval constinit values";
constexpr const char* words_of_fortran = "dp kind real values";
constexpr const char* intrinsics_of_fortran =
    "abs acos asin atan cos cosh dp exp kind log pi real sin sinh sources sqrt tan tanh values";
constexpr const char* words_of_python =
    "and as assert async await break class continue def del elif else except finally for from "
    "global if import in is lambda nonlocal not or pass raise return try while with yield None "
    "True False "
    // what the code uses itself
    "abs float ImportError";
constexpr const char* words_of_julia =
    "baremodule begin break catch const continue do else elseif end export false finally for "
    "function global if import let local macro module quote return struct true try using while "
    "in isa where im ℯ";
constexpr const char* words_of_freefem =
    "N P R R2 R3 area bool border break catch cin complex continue cout element else end endl "
    "false "
    "fespace "
    "for func hTriangle if ifstream include int intalledges lenEdge label load macro matrix mesh "
    "mesh3 nTonEdge nuEdge nuTriangle ofstream plot problem real region return solve string true "
    "try varf vertex volume while int1d int2d int3d on dx dy dz dxx dxy dyx dyy mean jump average "
    "abs arg conj det diag norm real imag trace max min pow rint round floor ceil erf erfc gamma "
    "lgamma tgamma j0 j1 jn y0 y1 yn i verbosity version time clock";
constexpr const char* words_of_moose =
    "e abs max min if int pow plog acosh arg asinh atan2 atanh cbrt ceil conj cot csc erf erfc "
    "exp2 floor hypot imag log10 log2 polar real rint round sec trunc";

/// With M_PI and the like, also with the endings of types.
std::set<std::string> all_macros() {
    std::set<std::string> all = words(macros_of_c);
    for (const auto& number :
         words("E LOG2E LOG10E LN2 LN10 PI PI_2 PI_4 1_PI 2_PI 2_SQRTPI SQRT2 SQRT1_2"))
        for (const char* end : {"", "f", "l", "f32", "f64", "f128", "f32x", "f64x"})
            all.insert("M_" + number + end);
    return all;
}

std::set<std::string> all_functions_of_c() {
    std::set<std::string> all;
    for (const auto& function : words(functions_of_c))
        for (const char* end :
             {"", "f", "l", "_r", "f_r", "l_r", "f32", "f64", "f128", "f32x", "f64x"})
            all.insert(function + end);
    return all;
}

/// Of stdio.h, string.h, time.h, ctype.h, signal.h, unistd.h and the like: a function of C that has
/// such a name takes its place in the whole program, without a word of the linker.
constexpr const char* linked_functions_of_c =
    "accept access alarm asctime asprintf assert basename bcmp bcopy bind brk bzero chdir chmod "
    "chown chroot clearerr clock clock_gettime close closedir confstr connect creat crypt ctime "
    "daemon difftime dirname dlopen dlsym dprintf dup dup2 environ errno err errx execl execle "
    "execlp execv execve execvp fclose fcntl fdopen feof ferror fflush fgetc fgetpos fgets fileno "
    "flock fopen fork fprintf fputc fputs fread freopen fscanf fseek fsetpos fstat fsync ftell "
    "ftime ftruncate fwrite getc getchar getcwd getline getopt getpid getppid gets gettimeofday "
    "getuid glob gmtime htonl htons ioctl isalnum isalpha isascii isatty isblank iscntrl isdigit "
    "isgraph islower isprint ispunct isspace isupper isxdigit kill lchown link listen localtime "
    "lockf longjmp lseek lstat memccpy memchr memcmp memcpy memmem memmove memset mkdir mkfifo "
    "mknod mktime mlock mmap mount mprotect munmap nanosleep nice open opendir pause pclose perror "
    "pipe poll popen pread printf psignal putc putchar puts pwrite raise read readdir readlink "
    "recv regcomp remove rename rewind rewinddir rmdir sbrk scanf send setbuf setjmp setlocale "
    "setuid setvbuf shutdown sigaction signal sleep snprintf socket splice sprintf sscanf stat "
    "stderr stdin stdout stime stpcpy strcat strchr strcmp strcoll strcpy strcspn strdup strerror "
    "strftime strlen strncat strncmp strncpy strndup strnlen strpbrk strptime strrchr strsep "
    "strsignal strspn strstr strtok strxfrm swab symlink sync syscall sysconf syslog tee "
    "tcgetattr tempnam time times timezone tmpfile tmpnam tolower toupper truncate ttyname tzname "
    "tzset ualarm umask umount uname ungetc unlink usleep utime vfork vfprintf vprintf vscanf "
    "vsnprintf vsprintf wait waitpid warn warnx wcscat wcschr wcscmp wcscpy wcslen write";

std::set<std::string> all_words_of_c() {
    std::set<std::string> all = words(words_of_c);
    all.merge(words(other_functions_of_c));
    all.merge(words(linked_functions_of_c));
    all.merge(all_macros());
    all.merge(all_functions_of_c());
    return all;
}

std::set<std::string> all_words_of_cpp() {
    std::set<std::string> all = words(words_of_cpp);
    all.merge(all_macros());
    return all;
}

} // namespace

const std::set<std::string>& reserved_words(CodeLanguage language) {
    // Each is made when it is first asked for.
    switch (language) {
    case CodeLanguage::c: {
        static const auto of_c = all_words_of_c();
        return of_c;
    }
    case CodeLanguage::cpp: {
        static const auto of_cpp = all_words_of_cpp();
        return of_cpp;
    }
    case CodeLanguage::fortran: {
        static const auto of_fortran = words(words_of_fortran);
        return of_fortran;
    }
    case CodeLanguage::python:
    case CodeLanguage::ufl: {
        static const auto of_python = words(words_of_python);
        return of_python;
    }
    case CodeLanguage::julia: {
        static const auto of_julia = words(words_of_julia);
        return of_julia;
    }
    case CodeLanguage::freefem: {
        static const auto of_freefem = words(words_of_freefem);
        return of_freefem;
    }
    case CodeLanguage::moose:
        break;
    }
    static const auto of_moose = words(words_of_moose);
    return of_moose;
}

std::set<std::string> global_names(CodeLanguage language) {
    if (language == CodeLanguage::fortran)
        return words(intrinsics_of_fortran);
    if (language != CodeLanguage::cpp)
        return {};
    std::set<std::string> all = all_functions_of_c();
    all.merge(words(other_functions_of_c));
    return all;
}

} // namespace tvbeam
