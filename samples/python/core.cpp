// Functions for the Python package: arrays in, arrays out. The package converts its arguments to these arrays.

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "engine/diffuse.h"
#include "engine/geodesic_distance.h"
#include "engine/options/option_table.h"
#include "partition/errors.h"
#include "partition/large_arrays.h"
#include "partition/version.h"
#include "samples/command/command_line.h"
#include "samples/options/smooth_request.h"
#include "samples/process/option_words.h"
#include "samples/programs.h"
#include "samples/python/flow_call.h"
#include "samples/python/work_thread.h"

namespace py = pybind11;

namespace seamflow {

namespace {

template <class Value>
using Array = py::array_t<Value, py::array::c_style>;

const char* name_of(FlowPhase phase)
{
    switch (phase) {
    case FlowPhase::Cut:
        return "cut";
    case FlowPhase::Analyse:
        return "analyse";
    case FlowPhase::Reference:
        return "reference";
    case FlowPhase::Step:
        break;
    }
    return "step";
}

/// @param corners of all faces, one after the other. @param offsets see PolygonMesh::face_offsets.
template <class Integer>
PolygonMesh make_mesh(const Array<double>& positions, const Array<Integer>& corners, const Array<std::int64_t>& offsets)
{
    constexpr std::int64_t most = std::numeric_limits<Index>::max();
    if (positions.shape(0) > most || corners.size() > most)
        throw InputError(fmt::format("the mesh has more than {} vertices or corners of faces", most));
    PolygonMesh mesh;
    mesh.vertices = Eigen::Map<const Points>(positions.data(), positions.shape(0), 3);
    mesh.face_offsets.assign(offsets.data(), offsets.data() + offsets.size());
    mesh.face_vertices.reserve(static_cast<std::size_t>(corners.size()));
    const Integer* const begin = corners.data();
    for (const Integer* corner = begin; corner != begin + corners.size(); ++corner) {
        if (!std::in_range<Index>(*corner)) {
            const auto after = std::upper_bound(mesh.face_offsets.begin(), mesh.face_offsets.end(), corner - begin);
            throw InputError(
                fmt::format("mesh: face {} (numbered from 0) names vertex {}, but the mesh has {} vertices",
                            after - mesh.face_offsets.begin() - 1, *corner, positions.shape(0)));
        }
        mesh.face_vertices.push_back(static_cast<Index>(*corner));
    }
    return mesh;
}

/// Runs work(control) without the GIL. Signals, and exceptions of `progress`, stop it.
template <class Work>
auto run_interruptibly(Work work, const py::object& progress)
{
    WorkThread<std::invoke_result_t<Work, const FlowControl&>> thread(std::move(work), !progress.is_none());
    std::exception_ptr raised;
    std::vector<FlowProgress> heard;
    for (bool is_over = false; !is_over;) {
        {
            const py::gil_scoped_release release;
            is_over = thread.wait(heard);
        }
        try {
            for (const FlowProgress& one : heard)
                if (!raised)
                    progress(name_of(one.phase), one.step, one.steps, one.fraction);
            if (!raised && PyErr_CheckSignals() != 0)
                throw py::error_already_set();
        } catch (...) {
            raised = std::current_exception();
            thread.stop();
        }
    }
    if (raised)
        std::rethrow_exception(raised);
    return thread.take();
}

/// An array that owns its data.
py::array_t<double> to_array(Points points)
{
    auto owner = std::make_unique<Points>(std::move(points));
    const py::capsule capsule(owner.get(), [](void* pointer) { delete static_cast<Points*>(pointer); });
    const Points& kept = *owner.release();
    return py::array_t<double>({kept.rows(), Points::Index{3}}, kept.data(), capsule);
}

template <class Value>
std::vector<Value> to_vector(const Array<Value>& array)
{
    return {array.data(), array.data() + array.size()};
}

/// Options that are arrays here: fixed vertices, labels, edges, weights, strengths.
using ArrayOptions = std::tuple<Array<Index>, Array<Index>, Array<Index>, Array<double>, Array<double>>;

/// Options and their texts; and the names of those that are arrays (see request_of).
using Keywords = std::pair<std::vector<std::pair<std::string, std::string>>, std::vector<std::string>>;

SmoothRequest make_request(const Keywords& keywords, const ArrayOptions& arrays)
{
    const auto& [fixed, labels, edges, weights, strengths] = arrays;
    SmoothRequest request = request_of(keywords.first, keywords.second);
    MotionOptions& motion = request.options.motion;
    motion.fixed_vertices = to_vector(fixed);
    request.options.cut.labels = to_vector(labels);
    for (py::ssize_t i = 0; i + 1 < edges.size(); i += 2)
        motion.feature_edges.push_back({edges.data()[i], edges.data()[i + 1]});
    motion.attachment_weights = to_vector(weights);
    motion.strength = to_vector(strengths);
    return request;
}

/// Positions, labels, report, and what was missed.
py::tuple to_tuple(FlowResult result)
{
    const py::array_t<Index> parts(static_cast<py::ssize_t>(result.labels.size()), result.labels.data());
    return py::make_tuple(to_array(std::move(result.positions)), parts, result.report, result.missed);
}

/// @param progress called with the phase, the step, the number of steps and the fraction that is done; or None.
template <class Integer>
py::tuple run(const Array<double>& positions, const Array<Integer>& corners, const Array<std::int64_t>& offsets,
              const Keywords& keywords, const ArrayOptions& arrays, const py::object& progress)
{
    SmoothRequest request = make_request(keywords, arrays);
    PolygonMesh mesh = make_mesh(positions, corners, offsets);
    const auto work = [&](const FlowControl& control) {
        return MeshCall(std::move(request), std::move(mesh)).smooth(control);
    };
    return to_tuple(run_interruptibly(work, progress));
}

template <class Integer>
std::unique_ptr<FlowCall> begin(const Array<double>& positions, const Array<Integer>& corners,
                                const Array<std::int64_t>& offsets, const Keywords& keywords,
                                const ArrayOptions& arrays)
{
    SmoothRequest request = make_request(keywords, arrays);
    PolygonMesh mesh = make_mesh(positions, corners, offsets);
    const py::gil_scoped_release release;
    return std::make_unique<FlowCall>(std::move(request), std::move(mesh));
}

template <class Integer>
void define_run(py::module_& module, py::class_<FlowCall>& flow)
{
    module.def("run", &run<Integer>, py::arg("positions").noconvert(), py::arg("corners").noconvert(),
               py::arg("offsets").noconvert(), py::arg("keywords"), py::arg("arrays"), py::arg("progress"));
    flow.def(py::init(&begin<Integer>), py::arg("positions").noconvert(), py::arg("corners").noconvert(),
             py::arg("offsets").noconvert(), py::arg("keywords"), py::arg("arrays"));
}

/// Name, type, description, whether it takes no value, and whether it is about where the surface goes, of each option.
py::list options()
{
    py::list list;
    SmoothRequest request;
    for (const RequestOption& option : request_options(request)) {
        const OptionTraits& traits = option.traits;
        if ((traits.concerns & (concern::files | concern::numbers)) != 0)
            continue;
        const std::string names = option.names.empty() ? std::string(traits.option) : option.names;
        for (std::size_t begin = 0; begin < names.size();) {
            const std::size_t end = std::min(names.find(',', begin), names.size());
            list.append(py::make_tuple(names.substr(begin + 2, end - begin - 2), option.reader.type,
                                       in_words_of_keywords(traits.text), option.reader.type.empty(),
                                       (traits.concerns & concern::motion) != 0));
            begin = end + 1;
        }
    }
    return list;
}

/// What diffuse() has besides the options of the program: a width, a number or a percentage, which is empty if another
/// amount is among the options; the differences above which fields keep their edges, 0 where all diffuse alike; whether
/// to fill gaps; and whether the boundary is free.
using FieldWords = std::tuple<std::string, double, bool, bool>;

/// @param fields #V by n, which receives the result.
FieldReport diffuse_fields(const PolygonMesh& mesh, const FlowOptions& of_flow, const FieldWords& of_fields,
                           Eigen::MatrixXd& fields, const FlowControl& control)
{
    const auto& [fwhm, keep_edges, fill, is_free] = of_fields;
    FieldOptions options;
    if (!fwhm.empty())
        options.fwhm = parse_length(fwhm);
    if (keep_edges != 0.0)
        options.keep_edges = keep_edges;
    options.laplacian = of_flow.laplacian;
    options.fill = fill;
    options.boundary = is_free ? Boundary::Free : Boundary::Fixed;
    return diffuse(mesh, fields, of_flow, options, control);
}

template <class Integer>
py::tuple diffuse_arrays(const Array<double>& positions, const Array<Integer>& corners,
                         const Array<std::int64_t>& offsets, const Keywords& keywords, const Array<Index>& fixed,
                         const Array<Index>& labels, const Array<double>& fields, const FieldWords& of_fields)
{
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const PolygonMesh mesh = make_mesh(positions, corners, offsets);
    Eigen::MatrixXd values;
    resize_large(values, fields.shape(0), fields.shape(1));
    values = Eigen::Map<const Rows>(fields.data(), fields.shape(0), fields.shape(1));
    FlowOptions options = request_of(keywords.first, keywords.second, true).options;
    options.motion.fixed_vertices = to_vector(fixed);
    options.cut.labels = to_vector(labels);
    const auto work = [&](const FlowControl& control) {
        return diffuse_fields(mesh, options, of_fields, values, control);
    };
    const FieldReport report = run_interruptibly(work, py::none());
    py::array_t<double> result({fields.shape(0), fields.shape(1)});
    Eigen::Map<Rows>(result.mutable_data(), fields.shape(0), fields.shape(1)) = values;
    py::list remarks;
    for (const RemarkInWords& remark : in_words_of_program(report.remarks)) {
        py::dict numbers;
        for (const auto& [name, value] : remark.numbers)
            numbers[py::str(name)] = value;
        py::dict one;
        one["kind"] = remark.kind;
        one["numbers"] = numbers;
        one["text"] = in_words_of_keywords(remark.text);
        remarks.append(one);
    }
    return py::make_tuple(result, report.fwhm, report.without_data, report.filled, report.flow.time_step, remarks,
                          report.flow.convergence.steps_short_of_tolerance);
}

template <class Integer>
std::unique_ptr<Geodesics> begin_geodesics(const Array<double>& positions, const Array<Integer>& corners,
                                           const Array<std::int64_t>& offsets, int threads)
{
    const PolygonMesh mesh = make_mesh(positions, corners, offsets);
    const py::gil_scoped_release release;
    return std::make_unique<Geodesics>(mesh, ResourceOptions{.threads = threads});
}

py::array_t<double> distance(Geodesics& geodesics, const Array<Index>& from)
{
    const std::vector<Index> sources = to_vector(from);
    const auto work = [&](const FlowControl& control) { return geodesics.distance(sources, control); };
    const Eigen::VectorXd distance = run_interruptibly(work, py::none());
    return py::array_t<double>(static_cast<py::ssize_t>(distance.size()), distance.data());
}

template <class Integer>
void define_fields(py::module_& module, py::class_<Geodesics>& geodesics)
{
    module.def("diffuse", &diffuse_arrays<Integer>, py::arg("positions").noconvert(), py::arg("corners").noconvert(),
               py::arg("offsets").noconvert(), py::arg("keywords"), py::arg("fixed"), py::arg("labels"),
               py::arg("fields"), py::arg("of_fields"));
    geodesics.def(py::init(&begin_geodesics<Integer>), py::arg("positions").noconvert(), py::arg("corners").noconvert(),
                  py::arg("offsets").noconvert(), py::arg("threads"));
}

void define_changes(py::class_<FlowCall>& flow)
{
    using Vertices = Array<Index>;
    flow.def("hold",
             [](FlowCall& call, const Vertices& vertices, bool is_fixed) {
                 const std::vector<Index> list = to_vector(vertices);
                 const py::gil_scoped_release release;
                 call.change([&](Flow& of_call) { is_fixed ? of_call.hold(list) : of_call.release(list); });
             })
        .def("move",
             [](FlowCall& call, const Vertices& vertices, const Array<double>& to) {
                 const std::vector<Index> list = to_vector(vertices);
                 const Points positions = Eigen::Map<const Points>(to.data(), to.shape(0), 3);
                 const py::gil_scoped_release release;
                 call.change([&](Flow& of_call) { of_call.move(list, positions); });
             })
        .def("attach", [](FlowCall& call, const Vertices& vertices, const Array<double>& weights) {
            const std::vector<Index> list = to_vector(vertices);
            const std::vector<double> of_list = to_vector(weights);
            const py::gil_scoped_release release;
            call.change([&](Flow& of_call) { of_call.attach(list, of_list); });
        });
}

/// Runs a program.
/// @param words its name and arguments.
int run_words(std::vector<std::string> words)
{
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const py::gil_scoped_release release;
    return run_program(words.front(), static_cast<int>(words.size()), arguments.data());
}

void translate(std::exception_ptr exception)
{
    try {
        std::rethrow_exception(std::move(exception));
    } catch (const InputError& error) {
        PyErr_SetString(PyExc_ValueError, in_words_of_keywords(sentence(error.wording(), option_of_program)).c_str());
    } catch (const OptionError& error) {
        PyErr_SetString(PyExc_ValueError, in_words_of_keywords(sentence(error.wording(), option_of_program)).c_str());
    }
}

}  // namespace

}  // namespace seamflow

PYBIND11_MODULE(_core, module)
{
    using namespace seamflow;
    // ComputationError is a std::runtime_error: pybind11 knows that.
    py::register_exception_translator(&translate);
    py::class_<FlowCall> flow(module, "Flow");
    define_run<std::int32_t>(module, flow);
    define_run<std::int64_t>(module, flow);
    define_changes(flow);
    py::class_<Geodesics> geodesics(module, "Geodesics");
    define_fields<std::int32_t>(module, geodesics);
    define_fields<std::int64_t>(module, geodesics);
    geodesics.def("distance", &distance, py::arg("from"));
    flow.def("step", &FlowCall::step, py::call_guard<py::gil_scoped_release>())
        .def("n_steps", &FlowCall::n_steps, py::call_guard<py::gil_scoped_release>())
        .def("positions",
             [](FlowCall& call) {
                 Points positions;
                 {
                     const py::gil_scoped_release release;
                     positions = call.positions();
                 }
                 return to_array(std::move(positions));
             })
        .def("result", [](FlowCall& call) {
            FlowResult result;
            {
                const py::gil_scoped_release release;
                result = call.result();
            }
            return to_tuple(std::move(result));
        });
    module.def(
        "options", &options,
        "Name, type, description, whether it is a flag and whether it moves the surface, of each keyword of smooth().");
    module.attr("version") = std::string(version);
    module.attr("licence") = gpl_parts().empty() ? "MIT" : "GPL-3.0-or-later";
    module.attr("about_licence") = about_licence();
    module.attr("programs") = std::vector<std::string>(programs.begin(), programs.end());
    module.def("run_program", &run_words, py::arg("words"));
}
