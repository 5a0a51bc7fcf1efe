#include <bit>
#include <cstdint>
#include <string>

#include "partition/io/palette.h"
#include "partition/io/ply.h"

namespace seamflow {

namespace {

const char* name_of(Encoding encoding)
{
    switch (encoding) {
    case Encoding::Ascii:
        return "ascii";
    case Encoding::BinaryLittleEndian:
        return "binary_little_endian";
    case Encoding::BinaryBigEndian:
        return "binary_big_endian";
    }
    return "";
}

bool has_long_face(const PolygonMesh& mesh)
{
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (mesh.face(f).size() > 255)
            return true;
    return false;
}

class PlyWriter {
  public:
    PlyWriter(OutputFile& file, const PolygonMesh& mesh, Encoding encoding)
        : file_(file)
        , mesh_(mesh)
        , encoding_(encoding)
        , long_faces_(has_long_face(mesh))
    {
    }

    void write_header(bool labelled);
    void write_vertices();
    void write_face(Index f);
    void write_label(Index label);
    void end_element()
    {
        if (encoding_ == Encoding::Ascii)
            file_.text("\n");
        begins_line_ = true;
    }

  private:
    void write(auto value)
    {
        if (encoding_ != Encoding::Ascii) {
            file_.binary(value, encoding_ == Encoding::BinaryBigEndian ? std::endian::big : std::endian::little);
            return;
        }
        if (!begins_line_)
            file_.text(" ");
        begins_line_ = false;
        file_.number(value);
    }

    OutputFile& file_;
    const PolygonMesh& mesh_;
    Encoding encoding_;
    bool long_faces_;
    bool begins_line_ = true;
};

void PlyWriter::write_header(bool labelled)
{
    std::string header = std::string("ply\nformat ") + name_of(encoding_) + " 1.0\n";
    header += "element vertex " + std::to_string(mesh_.n_vertices()) + "\n";
    header += "property double x\nproperty double y\nproperty double z\n";
    header += "element face " + std::to_string(mesh_.n_faces()) + "\n";
    header += std::string("property list ") + (long_faces_ ? "int" : "uchar") + " int vertex_indices\n";
    if (labelled)
        header += "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int label\n";
    file_.text(header + "end_header\n");
}

void PlyWriter::write_vertices()
{
    for (Index v = 0; v < mesh_.n_vertices(); ++v) {
        for (Index k = 0; k < 3; ++k)
            write(mesh_.vertices(v, k));
        end_element();
    }
}

void PlyWriter::write_face(Index f)
{
    const auto corners = mesh_.face(f);
    if (long_faces_)
        write(static_cast<std::int32_t>(corners.size()));
    else
        write(static_cast<std::uint8_t>(corners.size()));
    for (const Index v : corners)
        write(v);
}

void PlyWriter::write_label(Index label)
{
    for (const std::uint8_t channel : colour_of(label))
        write(channel);
    write(label);
}

}  // namespace

void write_ply(OutputFile& file, const PolygonMesh& mesh, Encoding encoding, std::span<const Index> labels)
{
    PlyWriter writer(file, mesh, encoding);
    writer.write_header(!labels.empty());
    writer.write_vertices();
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        writer.write_face(f);
        if (!labels.empty())
            writer.write_label(labels[static_cast<std::size_t>(f)]);
        writer.end_element();
    }
}

}  // namespace seamflow
