// Draws the meshes of mesa.cpp through Vulkan 1.3, on each of a list of devices. Vertices lie in the device's
// memory. draw() waits for the device, whose own clock times the drawing alone.
#include <fmt/format.h>
#include <sched.h>
#include <stdlib.h>

#include <vulkan.frag.h>  // made from the shaders beside this file
#include <vulkan.vert.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <vulkan/vulkan_raii.hpp>

#include "lab/peers/peer.h"

namespace edgewise::lab {

namespace {

enum class Driver { lavapipe, swiftshader, gpu };
constexpr std::string_view kNames[] = {"lavapipe", "swiftshader", "gpu"};
constexpr std::string_view name_of(Driver driver) {
  return kNames[static_cast<std::size_t>(driver)];
}

constexpr auto kColour = vk::Format::eR32Uint, kDepth = vk::Format::eD32Sfloat;

// Never destroyed, like the devices: drivers are known to crash when a process unloads them at its end.
const vk::raii::Instance& instance() {
  static const auto& context = *new vk::raii::Context;
  static const auto& made = *new auto([] {
    setenv("LP_NUM_THREADS", "0", 1);  // lavapipe draws in its queue's thread alone
    constexpr const char* kSwiftShader =
        EDGEWISE_SWIFTSHADER "/1/vk_swiftshader_icd.json:" EDGEWISE_SWIFTSHADER "/2/vk_swiftshader_icd.json";
    setenv("VK_ADD_DRIVER_FILES", kSwiftShader, 0);
    const vk::ApplicationInfo application("edgewise", 1, nullptr, 0, VK_API_VERSION_1_3);
    return vk::raii::Instance(context, vk::InstanceCreateInfo({}, &application));
  }());
  return made;
}

// A queue that draws and whose clock does not wrap within a frame.
std::optional<std::uint32_t> graphics_family(const vk::raii::PhysicalDevice& physical) {
  const auto families = physical.getQueueFamilyProperties();
  for (std::uint32_t i = 0; i < families.size(); ++i)
    if ((families[i].queueFlags & vk::QueueFlagBits::eGraphics) && families[i].timestampValidBits == 64)
      return i;
  return {};
}

bool is_of(const vk::raii::PhysicalDevice& physical, Driver driver) {
  const auto about =
      physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
  const auto id = about.get<vk::PhysicalDeviceDriverProperties>().driverID;
  if (driver == Driver::lavapipe) return id == vk::DriverId::eMesaLlvmpipe;
  if (driver == Driver::swiftshader) return id == vk::DriverId::eGoogleSwiftshader;
  const auto& properties = about.get<vk::PhysicalDeviceProperties2>().properties;
  if (const char* named = getenv("EDGEWISE_GPU"))
    return std::string_view(properties.deviceName).find(named) != std::string_view::npos;
  return properties.deviceType != vk::PhysicalDeviceType::eCpu &&
         properties.deviceType != vk::PhysicalDeviceType::eOther;
}

// Every device of Vulkan draws into kColour.
bool draws_our_frames(const vk::raii::PhysicalDevice& physical) {
  return physical.getProperties().apiVersion >= VK_API_VERSION_1_3 && graphics_family(physical) &&
         physical.getFormatProperties(kDepth).optimalTilingFeatures &
             vk::FormatFeatureFlagBits::eDepthStencilAttachment;
}

// That of SwiftShader is 4096 px.
float half_viewport_px(const vk::raii::PhysicalDevice& physical) {
  const auto side = physical.getProperties().limits.maxViewportDimensions;
  return static_cast<float>(
      std::min<std::uint32_t>(kHalfViewport_px, std::bit_floor(std::min(side[0], side[1])) / 2));
}

// SwiftShader's library has one pool of threads, and scripts/run unpacks two copies of it: the n-th device
// draws on n threads. Throws std::runtime_error if there is no such device.
vk::raii::PhysicalDevice find_device(Driver driver, int threads) try {
  int nth = 0;
  for (auto& device : vk::raii::PhysicalDevices(instance()))
    if (is_of(device, driver) && draws_our_frames(device) && ++nth == threads) return std::move(device);
  throw std::runtime_error(
      fmt::format("Vulkan offers no such device{}",
                  driver == Driver::swiftshader ? " (scripts/run --peers unpacks one)" : ""));
} catch (const std::runtime_error& error) {
  throw std::runtime_error(fmt::format("{}: {}", name_of(driver), error.what()));
}

// While it lives, the calling thread and those that it starts run on so many cores. SwiftShader has no
// setting for that.
class OnCores {
 public:
  explicit OnCores(int count) {
    sched_getaffinity(0, sizeof before_, &before_);
    cpu_set_t some = before_;
    for (std::size_t cpu = 0; cpu < CPU_SETSIZE; ++cpu)
      if (CPU_ISSET(cpu, &some) && count-- <= 0) CPU_CLR(cpu, &some);
    sched_setaffinity(0, sizeof some, &some);
  }
  ~OnCores() { sched_setaffinity(0, sizeof before_, &before_); }
  OnCores(const OnCores&) = delete;
  OnCores& operator=(const OnCores&) = delete;

 private:
  cpu_set_t before_;
};

vk::raii::Device make_device(const vk::raii::PhysicalDevice& physical, std::uint32_t family) {
  const float priority = 1.0f;
  const vk::DeviceQueueCreateInfo queue({}, family, 1, &priority);
  vk::PhysicalDeviceVulkan13Features features;
  features.dynamicRendering = true;
  return {physical, vk::DeviceCreateInfo({}, queue, {}, {}, nullptr, &features)};
}

vk::raii::Pipeline make_pipeline(const vk::raii::Device& device, const vk::raii::PipelineLayout& layout,
                                 float half_viewport_px) {
  const vk::raii::ShaderModule vertex(device, vk::ShaderModuleCreateInfo({}, kVulkan_vert));
  const vk::raii::ShaderModule fragment(device, vk::ShaderModuleCreateInfo({}, kVulkan_frag));
  const std::array stages{
      vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eVertex, *vertex, "main"),
      vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eFragment, *fragment, "main")};
  const std::array bindings{vk::VertexInputBindingDescription(0, sizeof(glm::vec3)),
                            vk::VertexInputBindingDescription(1, sizeof(std::uint32_t))};
  const std::array attributes{vk::VertexInputAttributeDescription(0, 0, vk::Format::eR32G32B32Sfloat),
                              vk::VertexInputAttributeDescription(1, 1, vk::Format::eR32Uint)};
  const vk::PipelineVertexInputStateCreateInfo input({}, bindings, attributes);
  const vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);
  const vk::Viewport viewport(-half_viewport_px, -half_viewport_px, 2 * half_viewport_px,
                              2 * half_viewport_px, 0, 1);
  vk::PipelineViewportStateCreateInfo viewports({}, 1, &viewport, 1);
  vk::PipelineRasterizationStateCreateInfo raster;
  raster.frontFace = vk::FrontFace::eClockwise;  // Vulkan's y points down, as ours
  raster.lineWidth = 1.0f;
  const vk::PipelineMultisampleStateCreateInfo samples;
  const vk::PipelineDepthStencilStateCreateInfo depth({}, true, true, vk::CompareOp::eLess);
  vk::PipelineColorBlendAttachmentState attachment;
  attachment.colorWriteMask = vk::ColorComponentFlagBits::eR;
  const vk::PipelineColorBlendStateCreateInfo blend({}, false, {}, attachment);
  const std::array dynamic_states{vk::DynamicState::eScissor, vk::DynamicState::eCullMode};
  const vk::PipelineDynamicStateCreateInfo dynamic({}, dynamic_states);
  const vk::PipelineRenderingCreateInfo formats(0, kColour, kDepth);
  return {
      device, nullptr,
      vk::GraphicsPipelineCreateInfo({}, stages, &input, &assembly, nullptr, &viewports, &raster, &samples,
                                     &depth, &blend, &dynamic, *layout, {}, 0, {}, 0, &formats)};
}

struct Buffer {
  vk::raii::Buffer buffer;
  vk::raii::DeviceMemory memory;
};

constexpr auto kHostMemory =
    vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;

struct Image {
  vk::ImageAspectFlags aspect;
  vk::raii::Image image;
  vk::raii::DeviceMemory memory;
  vk::raii::ImageView view;
};

// A device, and what its frames share.
class Device {
 public:
  explicit Device(vk::raii::PhysicalDevice physical) : physical_(std::move(physical)) {}

  int subpixel_bits() const {
    return static_cast<int>(physical_.getProperties().limits.subPixelPrecisionBits);
  }
  std::string version() const {
    const auto about =
        physical_.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties,
                                 vk::PhysicalDeviceSubgroupProperties>();
    const auto& properties = about.get<vk::PhysicalDeviceProperties2>().properties;
    const auto& driver = about.get<vk::PhysicalDeviceDriverProperties>();
    std::string text = fmt::format("{}, {} {}", properties.deviceName.data(), driver.driverName.data(),
                                   with_year(driver.driverInfo.data()));
    if (driver.driverID == vk::DriverId::eGoogleSwiftshader) {  // of another version, it tells the same
      std::string package;
      if (std::getline(std::ifstream(EDGEWISE_SWIFTSHADER "/package"), package))
        text = "SwiftShader of " + package;
    }
    text += fmt::format(", {} subpixel bits", subpixel_bits());
    if (properties.deviceType == vk::PhysicalDeviceType::eCpu)
      text += fmt::format(", {} bits", 32 * about.get<vk::PhysicalDeviceSubgroupProperties>().subgroupSize);
    return text;
  }
  const vk::raii::PipelineLayout& layout() const { return layout_; }
  const vk::raii::Pipeline& pipeline() const { return pipeline_; }

  Buffer buffer(std::size_t bytes, vk::BufferUsageFlags use, vk::MemoryPropertyFlags where) const {
    // Vulkan rejects empty buffers, and a scene may have no triangle in view.
    vk::raii::Buffer made(device_, vk::BufferCreateInfo({}, std::max<std::size_t>(bytes, 4), use));
    auto memory = allocate(made.getMemoryRequirements(), where);
    made.bindMemory(*memory, 0);
    return {std::move(made), std::move(memory)};
  }
  // In the device's memory.
  template <typename T>
  Buffer filled_buffer(const std::vector<T>& data, vk::BufferUsageFlags use) const {
    const std::size_t bytes = data.size() * sizeof(T);
    Buffer made =
        buffer(bytes, use | vk::BufferUsageFlagBits::eTransferDst, vk::MemoryPropertyFlagBits::eDeviceLocal);
    if (bytes == 0) return made;
    const Buffer staging = buffer(bytes, vk::BufferUsageFlagBits::eTransferSrc, kHostMemory);
    std::memcpy(staging.memory.mapMemory(0, bytes), data.data(), bytes);
    staging.memory.unmapMemory();
    const auto copying = commands();
    copying.begin(vk::CommandBufferBeginInfo());
    copying.copyBuffer(*staging.buffer, *made.buffer, vk::BufferCopy(0, 0, bytes));
    copying.pipelineBarrier(
        vk::PipelineStageFlagBits::eTransfer, vk::PipelineStageFlagBits::eVertexInput, {},
        vk::MemoryBarrier(vk::AccessFlagBits::eTransferWrite, vk::AccessFlagBits::eMemoryRead), {}, {});
    copying.end();
    run(copying);
    return made;
  }

  Image image(vk::Extent2D size, vk::Format format, vk::ImageUsageFlags use,
              vk::ImageAspectFlags aspect) const {
    vk::raii::Image made(device_,
                         vk::ImageCreateInfo({}, vk::ImageType::e2D, format, vk::Extent3D(size, 1), 1, 1,
                                             vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal,
                                             use | vk::ImageUsageFlagBits::eTransferSrc));
    auto memory = allocate(made.getMemoryRequirements(), vk::MemoryPropertyFlagBits::eDeviceLocal);
    made.bindMemory(*memory, 0);
    vk::raii::ImageView view(device_, vk::ImageViewCreateInfo({}, *made, vk::ImageViewType::e2D, format, {},
                                                              {aspect, 0, 1, 0, 1}));
    return {aspect, std::move(made), std::move(memory), std::move(view)};
  }

  vk::raii::CommandBuffer commands() const {
    return std::move(
        vk::raii::CommandBuffers(device_, {*pool_, vk::CommandBufferLevel::ePrimary, 1}).front());
  }

  void run(const vk::raii::CommandBuffer& commands) const {
    queue_.submit(vk::SubmitInfo({}, {}, *commands));
    queue_.waitIdle();
  }

  vk::raii::QueryPool clock() const {
    return {device_, vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, 2)};
  }
  float half_viewport_px() const { return half_viewport_px_; }
  double tick_s() const { return 1e-9 * double{physical_.getProperties().limits.timestampPeriod}; }

 private:
  vk::raii::DeviceMemory allocate(const vk::MemoryRequirements& needs, vk::MemoryPropertyFlags wanted) const {
    const auto memory = physical_.getMemoryProperties();
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
      if ((needs.memoryTypeBits >> i & 1) && (memory.memoryTypes[i].propertyFlags & wanted) == wanted)
        return {device_, vk::MemoryAllocateInfo(needs.size, i)};
    throw std::runtime_error("Vulkan's device has no memory of the kind that a frame needs");
  }

  vk::raii::PhysicalDevice physical_;
  std::uint32_t family_ = graphics_family(physical_).value();
  vk::raii::Device device_ = make_device(physical_, family_);
  vk::raii::Queue queue_{device_, family_, 0};
  vk::raii::CommandPool pool_{device_, vk::CommandPoolCreateInfo({}, family_)};
  float half_viewport_px_ = lab::half_viewport_px(physical_);
  vk::PushConstantRange matrix_{vk::ShaderStageFlagBits::eVertex, 0, sizeof(glm::mat4)};
  vk::raii::PipelineLayout layout_{device_, vk::PipelineLayoutCreateInfo({}, {}, matrix_)};
  vk::raii::Pipeline pipeline_ = make_pipeline(device_, layout_, half_viewport_px_);
};

const Device& device(Driver driver, int threads) {
  static auto& made = *new std::map<vk::PhysicalDevice, Device>;  // not by driver: EDGEWISE_GPU may change
  auto physical = find_device(driver, threads);
  std::optional<OnCores> on_cores;
  if (driver == Driver::swiftshader) on_cores.emplace(threads);
  return made.try_emplace(*physical, std::move(physical)).first->second;
}

struct LoadedMesh {
  Buffer positions, payloads, indices;
  std::uint32_t count;
  glm::mat4 to_clip;
};

LoadedMesh load_mesh(const Device& device, const PeerMesh& mesh) {
  // Vulkan takes a triangle's payload from its first vertex, so the last one becomes the first.
  std::vector<std::uint32_t> indices;
  const std::size_t count = mesh.indices.empty() ? mesh.positions.size() : mesh.indices.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t from = i - i % 3 + (i + 2) % 3;
    indices.push_back(mesh.indices.empty() ? static_cast<std::uint32_t>(from) : mesh.indices[from]);
  }
  return {device.filled_buffer(mesh.positions, vk::BufferUsageFlagBits::eVertexBuffer),
          device.filled_buffer(mesh.payloads, vk::BufferUsageFlagBits::eVertexBuffer),
          device.filled_buffer(indices, vk::BufferUsageFlagBits::eIndexBuffer),
          static_cast<std::uint32_t>(count), to_clip(mesh.to_screen, device.half_viewport_px())};
}

class VulkanFrame final : public PeerFrame {
 public:
  VulkanFrame(const Device& device, const PeerScene& scene)
      : device_(device),
        size_(static_cast<std::uint32_t>(scene.width), static_cast<std::uint32_t>(scene.height)),
        colours_(device.image(size_, kColour, vk::ImageUsageFlagBits::eColorAttachment,
                              vk::ImageAspectFlagBits::eColor)),
        depths_(device.image(size_, kDepth, vk::ImageUsageFlagBits::eDepthStencilAttachment,
                             vk::ImageAspectFlagBits::eDepth)),
        drawing_(device.commands()),
        clock_(device.clock()) {
    for (const PeerMesh& mesh : scene.meshes) meshes_.push_back(load_mesh(device, mesh));
    record(scene);
  }

  void draw() override { device_.run(drawing_); }
  std::optional<double> device_s() const override {
    const auto [result, ticks] =
        clock_.getResults<std::uint64_t>(0, 2, 2 * sizeof(std::uint64_t), sizeof(std::uint64_t),
                                         vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    return static_cast<double>(ticks[1] - ticks[0]) * device_.tick_s();
  }

  std::vector<std::uint32_t> read() override {
    using Access = vk::AccessFlagBits;
    using Stage = vk::PipelineStageFlagBits;
    std::vector<std::uint32_t> list(std::size_t{size_.width} * size_.height);
    const std::size_t bytes = list.size() * sizeof list[0];
    const Buffer copy = device_.buffer(bytes, vk::BufferUsageFlagBits::eTransferDst, kHostMemory);
    const auto copying = device_.commands();
    copying.begin(vk::CommandBufferBeginInfo());
    copying.pipelineBarrier(Stage::eAllGraphics, Stage::eTransfer, {},
                            vk::MemoryBarrier(Access::eMemoryWrite, Access::eTransferRead), {}, {});
    copying.copyImageToBuffer(
        *colours_.image, vk::ImageLayout::eGeneral, *copy.buffer,
        vk::BufferImageCopy(0, 0, 0, {colours_.aspect, 0, 0, 1}, {}, vk::Extent3D(size_, 1)));
    copying.pipelineBarrier(Stage::eTransfer, Stage::eHost, {},
                            vk::MemoryBarrier(Access::eTransferWrite, Access::eHostRead), {}, {});
    copying.end();
    device_.run(copying);
    std::memcpy(list.data(), copy.memory.mapMemory(0, bytes), bytes);
    copy.memory.unmapMemory();
    return list;
  }

 private:
  void record(const PeerScene& scene) {
    using Access = vk::AccessFlagBits;
    using Stage = vk::PipelineStageFlagBits;
    drawing_.begin(vk::CommandBufferBeginInfo());
    drawing_.resetQueryPool(*clock_, 0, 2);
    drawing_.writeTimestamp(Stage::eTopOfPipe, *clock_, 0);
    const auto to_attachment = [](const Image& image, Access access) {
      return vk::ImageMemoryBarrier({}, access, vk::ImageLayout::eUndefined, vk::ImageLayout::eGeneral,
                                    VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, *image.image,
                                    {image.aspect, 0, 1, 0, 1});
    };
    drawing_.pipelineBarrier(Stage::eTopOfPipe, Stage::eColorAttachmentOutput | Stage::eEarlyFragmentTests,
                             {}, {}, {},
                             {to_attachment(colours_, Access::eColorAttachmentWrite),
                              to_attachment(depths_, Access::eDepthStencilAttachmentWrite)});
    const vk::Rect2D all({0, 0}, size_);
    const auto attachment = [](const Image& image, vk::ClearValue clear) {
      return vk::RenderingAttachmentInfo(*image.view, vk::ImageLayout::eGeneral, {}, {}, {},
                                         vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore, clear);
    };
    const auto colour = attachment(colours_, vk::ClearColorValue(std::array{scene.background, 0u, 0u, 0u}));
    const auto depth = attachment(depths_, vk::ClearDepthStencilValue(1.0f, 0));
    drawing_.beginRendering(vk::RenderingInfo({}, all, 1, 0, colour, &depth));
    drawing_.bindPipeline(vk::PipelineBindPoint::eGraphics, *device_.pipeline());
    drawing_.setScissor(0, all);
    drawing_.setCullMode(scene.cull_back ? vk::CullModeFlagBits::eBack : vk::CullModeFlagBits::eNone);
    for (const LoadedMesh& mesh : meshes_) {
      drawing_.pushConstants<glm::mat4>(*device_.layout(), vk::ShaderStageFlagBits::eVertex, 0, mesh.to_clip);
      drawing_.bindVertexBuffers(0, {*mesh.positions.buffer, *mesh.payloads.buffer}, {0, 0});
      drawing_.bindIndexBuffer(*mesh.indices.buffer, 0, vk::IndexType::eUint32);
      drawing_.drawIndexed(mesh.count, 1, 0, 0, 0);
    }
    drawing_.endRendering();
    drawing_.writeTimestamp(Stage::eBottomOfPipe, *clock_, 1);
    drawing_.end();
  }

  const Device& device_;
  vk::Extent2D size_;
  Image colours_, depths_;
  std::vector<LoadedMesh> meshes_;
  vk::raii::CommandBuffer drawing_;
  vk::raii::QueryPool clock_;  // at the begin and at the end of the last frame
};

template <Driver driver, int most_threads>
PeerInfo vulkan_peer(std::string_view summary) {
  return {.name = name_of(driver),
          .summary = summary,
          .most_threads = most_threads,
          .own_clock = driver == Driver::gpu,
          .subpixel_bits = [] { return device(driver, 1).subpixel_bits(); },
          .version =
              [] {
                for (int threads = most_threads; threads > 1; --threads) device(driver, threads);
                return device(driver, 1).version();
              },
          .load = [](const PeerScene& scene, int threads) -> std::unique_ptr<PeerFrame> {
            return std::make_unique<VulkanFrame>(device(driver, threads), scene);
          }};
}

}  // namespace

PeerInfo lavapipe() {
  return vulkan_peer<Driver::lavapipe, 1>("Mesa's Vulkan for processors, with llvmpipe's rasterizer");
}
PeerInfo swiftshader() {
  return vulkan_peer<Driver::swiftshader, 2>(
      "Chromium's Vulkan for processors, SIMD code generated at run time");
}
PeerInfo vulkan_gpu() {
  return vulkan_peer<Driver::gpu, 1>("the first GPU that Vulkan offers, or the one that EDGEWISE_GPU names");
}

}  // namespace edgewise::lab
