// Mesa's software drivers, with their fastest settings: data in vertex buffers, one draw call per mesh, early
// depth test, payloads as flat integers. llvmpipe is the usual software OpenGL on Linux; its coverage is
// exact: 8 subpixel bits, half to even, top-left rule. softpipe is Mesa's reference driver, in plain C.
#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "lab/peers/mesa/egl.h"
#include "lab/peers/peer.h"

namespace edgewise::lab {

namespace {

// The position equals that of transform() in frontend/transform.h: `precise` forbids fused multiply-add.
// OpenGL 3.3 has it as an extension.
constexpr const char* kVertexShader = R"(#version 330 core
#extension GL_ARB_gpu_shader5 : require
#extension GL_ARB_explicit_uniform_location : require
layout(location = 0) uniform mat4 to_clip;
layout(location = 0) in vec3 position;
layout(location = 1) in uint payload;
flat out uint flat_payload;
void main() {
  precise vec4 p = to_clip[0] * position.x + to_clip[1] * position.y + to_clip[2] * position.z + to_clip[3];
  gl_Position = p;
  flat_payload = payload;
})";
constexpr const char* kFragmentShader = R"(#version 330 core
flat in uint flat_payload;
layout(location = 0) out uint colour;
void main() { colour = flat_payload; })";

GLuint compiled(GLenum stage, const char* text) {
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint done = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (!done) throw std::runtime_error("Mesa: a shader does not compile");
  return shader;
}

GLuint make_program() {
  const GLuint program = glCreateProgram();
  glAttachShader(program, compiled(GL_VERTEX_SHADER, kVertexShader));
  glAttachShader(program, compiled(GL_FRAGMENT_SHADER, kFragmentShader));
  glLinkProgram(program);
  GLint done = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &done);
  if (!done) throw std::runtime_error("Mesa: a program does not link");
  return program;
}

GLuint make_target(int width, int height) {
  GLuint planes[2], target = 0;
  glCreateRenderbuffers(2, planes);
  glNamedRenderbufferStorage(planes[0], GL_R32UI, width, height);
  glNamedRenderbufferStorage(planes[1], GL_DEPTH_COMPONENT32F, width, height);
  glCreateFramebuffers(1, &target);
  glNamedFramebufferRenderbuffer(target, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, planes[0]);
  glNamedFramebufferRenderbuffer(target, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, planes[1]);
  if (glCheckNamedFramebufferStatus(target, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("Mesa: cannot draw into integers");
  return target;
}

// The objects that the frames of one context share.
struct Shared {
  GLuint program = 0;
  std::map<std::pair<int, int>, GLuint> targets;  // by width and height
};

Shared& shared(MesaDriver driver, int threads) {
  static std::map<std::pair<MesaDriver, int>, Shared> all;
  Shared& s = all[{driver, threads}];
  if (s.program != 0) return s;
  s.program = make_program();
  glUseProgram(s.program);
  // Row 0 is the image's top row, so that the top-left rule has our orientation. Depth is in [0, 1].
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glViewport(-kHalfViewport_px, -kHalfViewport_px, 2 * kHalfViewport_px, 2 * kHalfViewport_px);
  glEnable(GL_DEPTH_TEST);
  glFrontFace(GL_CCW);  // OpenGL's y points up: clockwise on our screen
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  return s;
}

struct Mesh {
  GLuint vertices = 0, indices = 0;
  GLuint buffers[3]{};
  GLsizei count = 0;
  glm::mat4 to_clip;
};

template <typename T>
GLuint buffer_of(GLuint buffer, const std::vector<T>& data) {
  // OpenGL rejects empty buffers, and a scene may have no triangle in view.
  const std::size_t bytes = std::max<std::size_t>(data.size() * sizeof(T), 1);
  glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(bytes), data.empty() ? nullptr : data.data(), 0);
  return buffer;
}

Mesh load_mesh(const PeerMesh& given) {
  Mesh mesh;
  glCreateVertexArrays(1, &mesh.vertices);
  glCreateBuffers(3, mesh.buffers);
  glVertexArrayVertexBuffer(mesh.vertices, 0, buffer_of(mesh.buffers[0], given.positions), 0,
                            sizeof(glm::vec3));
  glVertexArrayVertexBuffer(mesh.vertices, 1, buffer_of(mesh.buffers[1], given.payloads), 0, 4);
  glVertexArrayAttribFormat(mesh.vertices, 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribIFormat(mesh.vertices, 1, 1, GL_UNSIGNED_INT, 0);
  for (const GLuint attribute : {0u, 1u}) {
    glVertexArrayAttribBinding(mesh.vertices, attribute, attribute);
    glEnableVertexArrayAttrib(mesh.vertices, attribute);
  }
  mesh.count = static_cast<GLsizei>(given.positions.size());
  if (!given.indices.empty()) {
    mesh.count = static_cast<GLsizei>(given.indices.size());
    mesh.indices = buffer_of(mesh.buffers[2], given.indices);
    glVertexArrayElementBuffer(mesh.vertices, mesh.indices);
  }
  mesh.to_clip = to_clip(given.to_screen);
  return mesh;
}

class Frame final : public PeerFrame {
 public:
  Frame(MesaDriver driver, const PeerScene& scene, int threads)
      : driver_(driver),
        threads_(threads),
        width_(scene.width),
        height_(scene.height),
        cull_(scene.cull_back),
        background_(scene.background) {
    use_mesa(driver, threads);
    auto& targets = shared(driver, threads).targets;
    const auto [at, is_new] = targets.try_emplace({width_, height_}, 0);
    if (is_new) at->second = make_target(width_, height_);
    target_ = at->second;
    for (const PeerMesh& mesh : scene.meshes) meshes_.push_back(load_mesh(mesh));
    glFinish();
    if (const GLenum error = glGetError(); error != GL_NO_ERROR)
      throw std::runtime_error(
          fmt::format("{}: OpenGL error {:#x} while loading a scene", name_of(driver), error));
  }

  ~Frame() override {
    use_mesa(driver_, threads_);
    for (const Mesh& mesh : meshes_) {
      glDeleteVertexArrays(1, &mesh.vertices);
      glDeleteBuffers(3, mesh.buffers);
    }
  }
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  void draw() override {
    use_mesa(driver_, threads_);
    glBindFramebuffer(GL_FRAMEBUFFER, target_);
    const GLuint background[4] = {background_, 0, 0, 0};
    const GLfloat far = 1.0f;
    glClearBufferuiv(GL_COLOR, 0, background);
    glClearBufferfv(GL_DEPTH, 0, &far);
    cull_ ? glEnable(GL_CULL_FACE) : glDisable(GL_CULL_FACE);
    for (const Mesh& mesh : meshes_) {
      glBindVertexArray(mesh.vertices);
      glUniformMatrix4fv(0, 1, GL_FALSE, &mesh.to_clip[0][0]);
      if (mesh.indices != 0)
        glDrawElements(GL_TRIANGLES, mesh.count, GL_UNSIGNED_INT, nullptr);
      else
        glDrawArrays(GL_TRIANGLES, 0, mesh.count);
    }
    glFinish();
  }

  std::vector<std::uint32_t> read() override {
    use_mesa(driver_, threads_);
    glBindFramebuffer(GL_FRAMEBUFFER, target_);
    std::vector<std::uint32_t> list(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    glReadPixels(0, 0, width_, height_, GL_RED_INTEGER, GL_UNSIGNED_INT, list.data());
    return list;
  }

 private:
  MesaDriver driver_;
  int threads_, width_, height_;
  bool cull_;
  std::uint32_t background_;
  GLuint target_ = 0;
  std::vector<Mesh> meshes_;
};

template <MesaDriver driver, int most_threads>
PeerInfo mesa_peer(std::string_view summary) {
  return {.name = name_of(driver),
          .summary = summary,
          .most_threads = most_threads,
          .exact = driver == MesaDriver::llvmpipe,
          .subpixel_bits =
              [] {
                use_mesa(driver, 1);
                GLint bits = 0;
                glGetIntegerv(GL_SUBPIXEL_BITS, &bits);
                return int{bits};
              },
          .version =
              [] {
                for (int threads = most_threads; threads > 1; --threads) use_mesa(driver, threads);
                return mesa_version(driver);
              },
          .load = [](const PeerScene& scene, int threads) -> std::unique_ptr<PeerFrame> {
            return std::make_unique<Frame>(driver, scene, threads);
          }};
}

}  // namespace

PeerInfo llvmpipe() {
  return mesa_peer<MesaDriver::llvmpipe, 2>("Mesa's OpenGL for processors, SIMD code generated at run time");
}
PeerInfo softpipe() {
  return mesa_peer<MesaDriver::softpipe, 1>("Mesa's reference driver of OpenGL, in plain C");
}

}  // namespace edgewise::lab
