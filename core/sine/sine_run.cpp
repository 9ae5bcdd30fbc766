#include "core/sine/sine_run.hpp"

#include "core/sine/form.hpp"

namespace tvbeam {

std::optional<RunResult> run_in_sines(const RunRequest& request, const ProblemData& data,
                                      const Mesh& mesh, const Needs& needs) {
    if (!SineForm::suits(data, mesh, request.scheme, request.norms))
        return std::nullopt;
    SineForm form(request.beam, data, mesh, request.scheme, request.final_time, request.steps,
                  request.norms, needs);
    if (form.loses_digits())
        return std::nullopt;
    RunResult result{.status = form.march(request.advance)};
    if (result.status == RunStatus::ok && !request.norms.empty())
        result.errors = form.errors();
    if (result.status == RunStatus::failed || !all_finite(result.errors))
        return std::nullopt;
    result.counters = form.counters();
    return result;
}

const char* sine_unit() {
    return chosen_sine_kernel().name;
}

} // namespace tvbeam
