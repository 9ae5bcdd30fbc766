#include "reports/command_line/commands/shown_run.hpp"

#include "reports/command_line/commands/said.hpp"
#include "reports/command_line/end_requests.hpp"
#include "reports/command_line/progress_line.hpp"
#include "studies/predicted_work.hpp"

namespace tvbeam {

namespace {

/// From here on a prediction is said: seconds.
constexpr double worth_saying = 60.0;

/// A bound of a time-out is generous: it is said where it is no bound to speak of.
bool is_worth_saying(const Scene& scene, const PredictedWork& predicted) {
    return predicted.seconds > worth_saying ||
           predicted.at_most > (scene.solver ? longest_work : worth_saying);
}

} // namespace

void predict(const Scene& scene, bool quiet, bool really_long) {
    const PredictedWork predicted = predicted_work(scene);
    if (!really_long)
        require_short_enough(scene, predicted);
    if (!quiet && is_worth_saying(scene, predicted))
        say(scene.name + " asks for " + predicted.text());
}

StudyResult run_shown(const Scene& scene, bool quiet, int jobs, FinishedRuns* finished) {
    ProgressLine progress(!quiet);
    return run_study(scene, {.jobs = jobs, .progress = &progress, .finished = finished});
}

bool write_reports(ReportDirectory& out, const Reported& result) {
    const std::string left_out = out.write(result);
    if (!left_out.empty())
        say(left_out);
    return left_out.empty() || !EndRequests::made();
}

} // namespace tvbeam
