// Draws the meshes of mesa.cpp through Vulkan 1.3, with Mesa's lavapipe and with the first GPU. lavapipe has
// llvmpipe's rasterizer behind other clipping and other shaders. draw() waits for the device, and vertices
// lie in memory that the processor sees, so these peers have no rows in the benchmark.
#include <fmt/format.h>
#include <stdlib.h>

#include <vulkan.frag.h>  // made from the shaders beside this file
#include <vulkan.vert.h>
#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <vulkan/vulkan_raii.hpp>

#include "lab/peers/peer.h"

namespace edgewise::lab {

namespace {

enum class Driver { lavapipe, gpu };

constexpr auto kColour = vk::Format::eR32Uint, kDepth = vk::Format::eD32Sfloat;

// Never destroyed, like the devices: drivers are known to crash when a process unloads them at its end.
const vk::raii::Instance& instance() {
  static const auto& context = *new vk::raii::Context;
  static const auto& made = *new auto([] {
    setenv("LP_NUM_THREADS", "0", 1);  // lavapipe draws in its queue's thread alone
    const vk::ApplicationInfo application("edgewise", 1, nullptr, 0, VK_API_VERSION_1_3);
    return vk::raii::Instance(context, vk::InstanceCreateInfo({}, &application));
  }());
  return made;
}

std::optional<std::uint32_t> graphics_family(const vk::raii::PhysicalDevice& physical) {
  const auto families = physical.getQueueFamilyProperties();
  for (std::uint32_t i = 0; i < families.size(); ++i)
    if (families[i].queueFlags & vk::QueueFlagBits::eGraphics) return i;
  return {};
}

// Whether it is the driver, and can draw our frames.
bool fits(const vk::raii::PhysicalDevice& physical, Driver driver) {
  const auto properties = physical.getProperties();
  if (properties.apiVersion < VK_API_VERSION_1_3 || !graphics_family(physical)) return false;
  const auto id = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>()
                      .get<vk::PhysicalDeviceDriverProperties>()
                      .driverID;
  const bool is_gpu = properties.deviceType == vk::PhysicalDeviceType::eDiscreteGpu ||
                      properties.deviceType == vk::PhysicalDeviceType::eIntegratedGpu ||
                      properties.deviceType == vk::PhysicalDeviceType::eVirtualGpu;
  if (driver == Driver::gpu ? !is_gpu : id != vk::DriverId::eMesaLlvmpipe) return false;
  const auto& side = properties.limits.maxViewportDimensions;
  const auto usable = [&](vk::Format format, vk::FormatFeatureFlagBits use) {
    return bool{physical.getFormatProperties(format).optimalTilingFeatures & use};
  };
  return std::min(side[0], side[1]) >= 2 * kHalfViewport_px &&
         usable(kColour, vk::FormatFeatureFlagBits::eColorAttachment) &&
         usable(kDepth, vk::FormatFeatureFlagBits::eDepthStencilAttachment);
}

std::optional<vk::raii::PhysicalDevice> find_device(Driver driver) {
  for (auto& device : vk::raii::PhysicalDevices(instance()))
    if (fits(device, driver)) return std::move(device);
  return {};
}

vk::raii::Device make_device(const vk::raii::PhysicalDevice& physical, std::uint32_t family) {
  const float priority = 1.0f;
  const vk::DeviceQueueCreateInfo queue({}, family, 1, &priority);
  vk::PhysicalDeviceVulkan13Features features;
  features.dynamicRendering = true;
  return {physical, vk::DeviceCreateInfo({}, queue, {}, {}, nullptr, &features)};
}

vk::raii::Pipeline make_pipeline(const vk::raii::Device& device, const vk::raii::PipelineLayout& layout) {
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
  const vk::Viewport viewport(-kHalfViewport_px, -kHalfViewport_px, 2 * kHalfViewport_px,
                              2 * kHalfViewport_px, 0, 1);
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

struct Image {
  vk::raii::Image image;
  vk::raii::DeviceMemory memory;
  vk::raii::ImageView view;
};

// A device, and what its frames share.
class Device {
 public:
  explicit Device(Driver driver) : physical_(find_device(driver).value()) {}

  int subpixel_bits() const {
    return static_cast<int>(physical_.getProperties().limits.subPixelPrecisionBits);
  }
  std::string version() const {
    const auto about =
        physical_.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
    const auto& driver = about.get<vk::PhysicalDeviceDriverProperties>();
    return fmt::format("{}, {} {}", about.get<vk::PhysicalDeviceProperties2>().properties.deviceName.data(),
                       driver.driverName.data(), driver.driverInfo.data());
  }
  const vk::raii::PipelineLayout& layout() const { return layout_; }
  const vk::raii::Pipeline& pipeline() const { return pipeline_; }

  Buffer buffer(std::size_t bytes, vk::BufferUsageFlags use, const void* data = nullptr) const {
    // Vulkan rejects empty buffers, and a scene may have no triangle in view.
    vk::raii::Buffer made(device_, vk::BufferCreateInfo({}, std::max<std::size_t>(bytes, 4), use));
    auto memory = allocate(made.getMemoryRequirements(), vk::MemoryPropertyFlagBits::eHostVisible |
                                                             vk::MemoryPropertyFlagBits::eHostCoherent);
    made.bindMemory(*memory, 0);
    if (data != nullptr && bytes != 0) {
      std::memcpy(memory.mapMemory(0, bytes), data, bytes);
      memory.unmapMemory();
    }
    return {std::move(made), std::move(memory)};
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
    return {std::move(made), std::move(memory), std::move(view)};
  }

  vk::raii::CommandBuffer commands() const {
    return std::move(
        vk::raii::CommandBuffers(device_, {*pool_, vk::CommandBufferLevel::ePrimary, 1}).front());
  }

  void run(const vk::raii::CommandBuffer& commands) const {
    queue_.submit(vk::SubmitInfo({}, {}, *commands));
    queue_.waitIdle();
  }

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
  vk::PushConstantRange matrix_{vk::ShaderStageFlagBits::eVertex, 0, sizeof(glm::mat4)};
  vk::raii::PipelineLayout layout_{device_, vk::PipelineLayoutCreateInfo({}, {}, matrix_)};
  vk::raii::Pipeline pipeline_ = make_pipeline(device_, layout_);
};

template <Driver driver>
const Device& device() {
  static const auto& made = *new Device(driver);
  return made;
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
  const auto buffer_of = [&](const auto& list, vk::BufferUsageFlags use) {
    return device.buffer(list.size() * sizeof(list[0]), use, list.data());
  };
  return {buffer_of(mesh.positions, vk::BufferUsageFlagBits::eVertexBuffer),
          buffer_of(mesh.payloads, vk::BufferUsageFlagBits::eVertexBuffer),
          buffer_of(indices, vk::BufferUsageFlagBits::eIndexBuffer), static_cast<std::uint32_t>(count),
          to_clip(mesh.to_screen)};
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
        drawing_(device.commands()) {
    for (const PeerMesh& mesh : scene.meshes) meshes_.push_back(load_mesh(device, mesh));
    record(scene);
  }

  void draw() override { device_.run(drawing_); }
  std::vector<std::uint32_t> read() override {
    return pixels<std::uint32_t>(*colours_.image, vk::ImageAspectFlagBits::eColor);
  }
  std::vector<float> read_depths() override {
    return pixels<float>(*depths_.image, vk::ImageAspectFlagBits::eDepth);
  }

 private:
  void record(const PeerScene& scene) {
    using Aspect = vk::ImageAspectFlagBits;
    using Access = vk::AccessFlagBits;
    using Stage = vk::PipelineStageFlagBits;
    drawing_.begin(vk::CommandBufferBeginInfo());
    const auto to_attachment = [](vk::Image image, Aspect aspect, Access access) {
      return vk::ImageMemoryBarrier({}, access, vk::ImageLayout::eUndefined, vk::ImageLayout::eGeneral,
                                    VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image,
                                    {aspect, 0, 1, 0, 1});
    };
    drawing_.pipelineBarrier(
        Stage::eTopOfPipe, Stage::eColorAttachmentOutput | Stage::eEarlyFragmentTests, {}, {}, {},
        {to_attachment(*colours_.image, Aspect::eColor, Access::eColorAttachmentWrite),
         to_attachment(*depths_.image, Aspect::eDepth, Access::eDepthStencilAttachmentWrite)});
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
    drawing_.end();
  }

  template <typename T>
  std::vector<T> pixels(vk::Image image, vk::ImageAspectFlags aspect) const {
    using Access = vk::AccessFlagBits;
    using Stage = vk::PipelineStageFlagBits;
    std::vector<T> list(std::size_t{size_.width} * size_.height);
    const std::size_t bytes = list.size() * sizeof(T);
    const Buffer copy = device_.buffer(bytes, vk::BufferUsageFlagBits::eTransferDst);
    const auto copying = device_.commands();
    copying.begin(vk::CommandBufferBeginInfo());
    copying.pipelineBarrier(Stage::eAllGraphics, Stage::eTransfer, {},
                            vk::MemoryBarrier(Access::eMemoryWrite, Access::eTransferRead), {}, {});
    copying.copyImageToBuffer(image, vk::ImageLayout::eGeneral, *copy.buffer,
                              vk::BufferImageCopy(0, 0, 0, {aspect, 0, 0, 1}, {}, vk::Extent3D(size_, 1)));
    copying.pipelineBarrier(Stage::eTransfer, Stage::eHost, {},
                            vk::MemoryBarrier(Access::eTransferWrite, Access::eHostRead), {}, {});
    copying.end();
    device_.run(copying);
    std::memcpy(list.data(), copy.memory.mapMemory(0, bytes), bytes);
    copy.memory.unmapMemory();
    return list;
  }

  const Device& device_;
  vk::Extent2D size_;
  Image colours_, depths_;
  std::vector<LoadedMesh> meshes_;
  vk::raii::CommandBuffer drawing_;
};

template <Driver driver>
std::optional<PeerInfo> peer_if_found(std::string_view name, std::string_view summary) try {
  if (!find_device(driver)) return {};
  return PeerInfo{name,
                  summary,
                  1,
                  [] { return device<driver>().subpixel_bits(); },
                  [] { return device<driver>().version(); },
                  [](const PeerScene& scene, int) -> std::unique_ptr<PeerFrame> {
                    return std::make_unique<VulkanFrame>(device<driver>(), scene);
                  }};
} catch (const std::runtime_error&) {
  return {};  // no loader, or no driver
}

}  // namespace

std::optional<PeerInfo> lavapipe() {
  return peer_if_found<Driver::lavapipe>("lavapipe",
                                         "Mesa's Vulkan for processors, with llvmpipe's rasterizer");
}

std::optional<PeerInfo> vulkan_gpu() {
  return peer_if_found<Driver::gpu>("gpu", "the first GPU that Vulkan offers; times include waiting for it");
}

}  // namespace edgewise::lab
