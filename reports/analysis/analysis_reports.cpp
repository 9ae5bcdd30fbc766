#include "reports/analysis/analysis_reports.hpp"

#include "reports/analysis/analysis_document.hpp"
#include "reports/document/json_text.hpp"
#include "reports/plots/drawing.hpp"
#include "reports/plots/plot_style.hpp"
#include "reports/studies/fit_fields.hpp"
#include "reports/studies/run_fields.hpp"
#include "studies/data/refined_widths.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const OrderInterval& interval) {
    const auto known = [&](double number) {
        return number_json(interval.determined ? std::optional(number) : std::nullopt);
    };
    Json json{{"value", known(interval.value)},
              {"low", known(interval.low)},
              {"high", known(interval.high)}};
    if (!interval.determined)
        json["status"] = interval.status;
    return json;
}

Json json_of(const MethodAnswer& method, const LimitEstimate& limit) {
    const auto figure = [&](double MethodLimit::*of) {
        return number_json(method ? std::optional((*method).*of) : std::nullopt);
    };
    Json json{{"limit", figure(&MethodLimit::limit)},
              {"uncertainty", figure(&MethodLimit::uncertainty)},
              {"order", figure(&MethodLimit::order)},
              {"model", method ? Json(method->model) : Json()}};
    if (!method)
        json["status"] = method.silence.empty() ? limit.limit.status : method.silence;
    else if (json["order"].is_null())
        json["status"] = "its model has more than one order";
    return json;
}

/// Between this row and the one before; none in rows that do not follow each other.
std::optional<double> order_of(const ColumnAnalysis& column, std::size_t row) {
    return column.orders.empty() ? std::nullopt : column.orders[row];
}

/// What its text prints of a grid, and which widths are h and dt of the model.
Json fit_of(const DataAnalysis& analysis, const ColumnAnalysis& column) {
    const auto& h = analysis.widths[column.of_model.first];
    const auto& dt = analysis.widths[column.of_model.second];
    Json json{{"h", h.name}, {"dt", dt.name}};
    json.update(fit_json(*column.two_term, [&](std::size_t row) -> Json {
        return {{h.name, h.numbers[row]}, {dt.name, dt.numbers[row]}};
    }));
    return json;
}

Json json_of(const DataAnalysis& analysis, const ColumnAnalysis& column) {
    Json rows = Json::array();
    for (std::size_t i = 0; i < analysis.rows(); ++i) {
        Json row = Json::object();
        for (const auto& width : analysis.widths)
            row[width.name] = width.numbers[i];
        row[column.is_value ? "value" : "error"] = number_json(column.numbers[i]);
        if (!column.verdicts.empty()) {
            row["order"] = number_json(order_of(column, i));
            row["verdict"] = name_of(column.verdicts[i].verdict);
            row["reason"] = column.verdicts[i].reason;
        }
        rows.push_back(std::move(row));
    }
    Json json{{"name", column.name},
              {"kind", column.is_value ? "value" : "error"},
              {"rows", std::move(rows)}};
    add_analysis(json, analysis, column);
    if (column.two_term)
        json["fit"] = fit_of(analysis, column);
    return json;
}

/// Blocks of more rows than this draw nothing that fewer do not.
constexpr std::size_t most_points = 2000;

std::string points_of(const DataColumn& width, const ColumnAnalysis& column) {
    std::string rows;
    const std::size_t step = 1 + column.numbers.size() / most_points;
    for (std::size_t i = 0; i < column.numbers.size(); i += step)
        if (is_drawable(column.numbers[i], !column.is_value))
            rows += fmt::format("{} {}\n", width.numbers[i], column.numbers[i]);
    return rows;
}

/// A line of the determined order through the finest positive error.
void add_order_line(const DataColumn& width, const ColumnAnalysis& column,
                    const OrderInterval& order, const SeriesStyle& style, Drawing& drawing) {
    std::size_t last = column.numbers.size();
    while (last > 0 && !is_drawable(column.numbers[last - 1], true))
        --last;
    if (!order.determined || column.two_term || last == 0)
        return;
    std::string rows;
    for (const double x : {width.numbers.front(), width.numbers[last - 1]})
        rows += fmt::format("{} {}\n", x,
                            column.numbers[last - 1] *
                                std::pow(x / width.numbers[last - 1], order.value));
    drawing.add_curve({.block = drawing.add_block(column.name + ": its order", rows)},
                      look_of(style, CurveLook::Kind::lines));
}

Axis width_axis(const DataColumn& width) {
    constexpr std::size_t most_ticks = 6;
    return {.title = width.name,
            .is_logarithmic = true,
            .range = range_of(width.numbers, 1.5),
            .ticks = value_ticks(width.numbers, most_ticks)};
}

Plot value_plot(const DataColumn& width, const ColumnAnalysis& column) {
    Drawing drawing;
    const auto& limit = column.limit->limit;
    if (limit.determined) {
        const auto [least, greatest] =
            std::minmax_element(width.numbers.begin(), width.numbers.end());
        std::string rows;
        for (const double x : {*least, *greatest})
            rows += fmt::format("{} {} {} {}\n", x, limit.low, limit.value, limit.high);
        const std::size_t block = drawing.add_block("limit: low, value, high", rows);
        drawing.add_curve({.block = block, .third = 4},
                          {.kind = CurveLook::Kind::band, .colour = "#deebf7"},
                          "95 % interval of the limit");
        drawing.add_curve({.block = block, .y = 3}, {.colour = "#08519c", .width = 1.2}, "limit");
    }
    drawing.add_curve({.block = drawing.add_block(column.name, points_of(width, column))},
                      look_of(series_style(0)), column.name);
    drawing.x = width_axis(width);
    drawing.y.title = column.name;
    return {"value_" + column.name, column.name + " against " + width.name + ", with its limit.",
            drawing};
}

} // namespace

void add_analysis(Json& json, const DataAnalysis& analysis, const ColumnAnalysis& column) {
    Json orders = Json::object();
    for (std::size_t i = 0; i < analysis.widths.size(); ++i)
        orders[analysis.widths[i].name] = json_of(column.by_width[i]);
    json["orders"] = std::move(orders);
    json["findings"] = column.findings;
    if (column.limit) {
        json["limit"] = json_of(column.limit->limit);
        json["uncertainty"] = number_json(column.limit->uncertainty);
        if (json["uncertainty"].is_null())
            json["status"] = column.limit->limit.status;
        json["methods"] = {{"gci", json_of(column.limit->gci, *column.limit)},
                           {"celik", json_of(column.limit->celik, *column.limit)},
                           {"eca_hoekstra", json_of(column.limit->eca_hoekstra, *column.limit)}};
    }
}

std::vector<Plot> value_plots(const DataAnalysis& analysis) {
    const DataColumn& width = analysis.widths[leading_width(analysis.widths)];
    std::vector<Plot> plots;
    for (const auto& column : analysis.columns)
        if (column.is_value && !points_of(width, column).empty())
            plots.push_back(value_plot(width, column));
    return plots;
}

std::string analysis_json(const DataAnalysis& analysis) {
    Json sizes = Json::array();
    for (const auto& width : analysis.widths)
        sizes.push_back(width.name);
    Json columns = Json::array();
    for (const auto& column : analysis.columns)
        columns.push_back(json_of(analysis, column));
    const Json json{{"schema", "tvbeam-analysis/1"},
                    {"file", analysis.name},
                    {"sizes", std::move(sizes)},
                    {"remarks", analysis.remarks},
                    {"columns", std::move(columns)}};
    return json_text(json);
}

std::string analysis_csv(const DataAnalysis& analysis) {
    std::string text;
    for (const auto& width : analysis.widths)
        text += (text.empty() ? "" : ",") + quoted(width.name);
    for (const auto& column : analysis.columns) {
        text += "," + quoted(column.name);
        if (!column.verdicts.empty())
            text += "," + quoted(column.name + "_order") + "," + quoted(column.name + "_verdict");
    }
    text += "\n";
    for (std::size_t i = 0; i < analysis.rows(); ++i) {
        for (std::size_t k = 0; k < analysis.widths.size(); ++k)
            text += fmt::format("{}{}", k == 0 ? "" : ",", analysis.widths[k].numbers[i]);
        for (const auto& column : analysis.columns) {
            // What is not there stays empty, and what failed does not.
            text += has_failed(column, i) ? fmt::format(",{}", column.numbers[i])
                                          : finite_field(column.numbers[i]);
            if (!column.verdicts.empty())
                text +=
                    number_field(order_of(column, i)) + "," + name_of(column.verdicts[i].verdict);
        }
        text += "\n";
    }
    return text;
}

std::vector<Plot> analysis_plots(const DataAnalysis& analysis) {
    const std::size_t along = leading_width(analysis.widths);
    const DataColumn& width = analysis.widths[along];
    auto plots = value_plots(analysis);
    Drawing drawing;
    std::vector<double> errors;
    for (std::size_t k = 0; k < analysis.columns.size(); ++k) {
        const auto& column = analysis.columns[k];
        if (column.is_value)
            continue;
        std::ranges::copy_if(column.numbers, std::back_inserter(errors),
                             [](double error) { return is_drawable(error, true); });
        const std::string points = points_of(width, column);
        if (points.empty())
            continue;
        const SeriesStyle style = series_style(k);
        drawing.add_curve({.block = drawing.add_block(column.name, points)},
                          look_of(style, CurveLook::Kind::points), column.name);
        add_order_line(width, column, column.by_width[along], style, drawing);
    }
    if (errors.empty())
        return with_file_names(std::move(plots));
    drawing.x = width_axis(width);
    drawing.y = {.title = "error", .is_logarithmic = true, .range = range_of(errors, 2.0)};
    plots.insert(plots.begin(), {"convergence",
                                 "Errors against " + width.name +
                                     ", on logarithmic axes; lines: orders that are determined.",
                                 drawing});
    return with_file_names(std::move(plots));
}

Reported reported(const DataAnalysis& analysis) {
    return {.document = analysis_document(analysis),
            .json = [&analysis] { return analysis_json(analysis); },
            .csvs =
                [&analysis] {
                    return std::vector<NamedText>{{"analysis.csv", analysis_csv(analysis)}};
                },
            .plots = [&analysis] { return analysis_plots(analysis); }};
}

} // namespace tvbeam
