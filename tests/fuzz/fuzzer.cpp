// libFuzzer's entry for one target, which TVBEAM_FUZZ_TARGET names.

#include "tests/fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tvbeam::fuzz::TVBEAM_FUZZ_TARGET({data, size});
    return 0;
}
