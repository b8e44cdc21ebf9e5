// Creates an instance, a device, one pipeline layout for all programs, and a graphics pipeline per program.
#include "renderer/gpu_cost/vulkan_compiler.hpp"

#define VK_NO_PROTOTYPES
#include <array>
#include <chrono>
#include <memory>
#include <utility>
#include <vulkan/vulkan_raii.hpp>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

constexpr std::uint32_t most_textures = 32, most_blocks = 9, most_attributes = 16;

Error vulkan_error(const std::string& place, const std::string& message) {
  return {ErrorKind::machine, place, message,
          "install the packages libvulkan1 and mesa-vulkan-drivers (Mesa's driver for AMD)"};
}

vk::raii::Context loaded() {
  try {
    return {};
  } catch (const std::runtime_error&) {
    throw vulkan_error("libvulkan.so.1", "cannot be loaded");
  }
}

vk::raii::Instance create_instance(const vk::raii::Context& context) {
  const vk::ApplicationInfo application({}, 0, {}, 0, VK_API_VERSION_1_1);
  return {context, vk::InstanceCreateInfo({}, &application)};
}

vk::raii::PhysicalDevice first_device(const vk::raii::Instance& instance) {
  vk::raii::PhysicalDevices devices(instance);
  if (devices.empty()) throw vulkan_error("Vulkan", "there is no device");
  return std::move(devices.front());
}

vk::raii::Device create_device(const vk::raii::PhysicalDevice& physical) {
  const float priority = 1.0F;
  const vk::DeviceQueueCreateInfo queue({}, 0, 1, &priority);
  const vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR statistics(VK_TRUE);
  const char* const extension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
  const auto features =
      vk::PhysicalDeviceFeatures().setSamplerAnisotropy(VK_TRUE).setShaderImageGatherExtended(VK_TRUE);
  return {physical, vk::DeviceCreateInfo({}, queue, {}, extension, &features, &statistics)};
}

vk::raii::DescriptorSetLayout all_bindings(const vk::raii::Device& device) {
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  const auto add = [&](std::uint32_t binding, vk::DescriptorType type) {
    bindings.emplace_back(binding, type, 1, vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment);
  };
  for (std::uint32_t i = 0; i < most_textures; ++i) add(i, vk::DescriptorType::eCombinedImageSampler);
  for (std::uint32_t i = 0; i < most_blocks; ++i)
    add(vulkan_binding::first_block + i, vk::DescriptorType::eUniformBuffer);
  add(vulkan_binding::plain_uniforms, vk::DescriptorType::eUniformBuffer);
  return {device, vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

vk::Format format_of(const ColorTarget& target) {
  if (target.bits == 16)
    return target.channels == 1   ? vk::Format::eR16Sfloat
           : target.channels == 2 ? vk::Format::eR16G16Sfloat
                                  : vk::Format::eR16G16B16A16Sfloat;
  return target.channels == 1   ? vk::Format::eR32Sfloat
         : target.channels == 2 ? vk::Format::eR32G32Sfloat
                                : vk::Format::eR32G32B32A32Sfloat;
}

// A pass that draws into these targets.
vk::raii::RenderPass create_render_pass(const vk::raii::Device& device, const std::vector<ColorTarget>& targets) {
  std::vector<vk::AttachmentDescription> attachments;
  std::vector<vk::AttachmentReference> references;
  for (const ColorTarget& target : targets) {
    references.emplace_back(static_cast<std::uint32_t>(references.size()), vk::ImageLayout::eColorAttachmentOptimal);
    attachments.push_back(vk::AttachmentDescription()
                              .setFormat(format_of(target))
                              .setLoadOp(vk::AttachmentLoadOp::eClear)
                              .setFinalLayout(vk::ImageLayout::eGeneral));
  }
  const vk::SubpassDescription subpass({}, vk::PipelineBindPoint::eGraphics, {}, references);
  return {device, vk::RenderPassCreateInfo({}, attachments, subpass)};
}

struct CompilingDevice {
  vk::raii::Context context = loaded();
  vk::raii::Instance instance = create_instance(context);
  vk::raii::PhysicalDevice physical = first_device(instance);
  std::string name = static_cast<const char*>(physical.getProperties().deviceName);
  vk::raii::Device device = create_device(physical);
  vk::raii::DescriptorSetLayout set = all_bindings(device);
  vk::raii::PipelineLayout layout{device, vk::PipelineLayoutCreateInfo({}, *set)};
};

// Float vertex attributes, and all channels of each target written.
vk::raii::Pipeline create_pipeline(const CompilingDevice& on, const SpirvProgram& program) {
  const vk::raii::Device& device = on.device;
  const vk::raii::ShaderModule vertex(device, vk::ShaderModuleCreateInfo({}, program.vertex));
  const vk::raii::ShaderModule fragment(device, vk::ShaderModuleCreateInfo({}, program.fragment));
  const std::array<vk::PipelineShaderStageCreateInfo, 2> stages{
      {{{}, vk::ShaderStageFlagBits::eVertex, *vertex, "main"},
       {{}, vk::ShaderStageFlagBits::eFragment, *fragment, "main"}}};
  const vk::VertexInputBindingDescription stream(0, 16 * most_attributes);
  std::vector<vk::VertexInputAttributeDescription> attributes;
  for (std::uint32_t i = 0; i < most_attributes; ++i)
    attributes.emplace_back(i, 0, vk::Format::eR32G32B32A32Sfloat, 16 * i);
  const vk::PipelineVertexInputStateCreateInfo vertices({}, stream, attributes);
  const vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);
  const vk::Viewport area(0, 0, 512, 512, 0, 1);
  const vk::Rect2D scissor({0, 0}, {512, 512});
  const vk::PipelineViewportStateCreateInfo viewport({}, area, scissor);
  const auto raster = vk::PipelineRasterizationStateCreateInfo().setLineWidth(1.0F);
  const vk::PipelineMultisampleStateCreateInfo samples;
  using enum vk::ColorComponentFlagBits;
  const std::vector<vk::PipelineColorBlendAttachmentState> written(
      program.targets.size(), vk::PipelineColorBlendAttachmentState().setColorWriteMask(eR | eG | eB | eA));
  const vk::PipelineColorBlendStateCreateInfo blend({}, VK_FALSE, vk::LogicOp::eClear, written);
  const vk::raii::RenderPass pass = create_render_pass(device, program.targets);
  using enum vk::PipelineCreateFlagBits;
  return {device, nullptr,
          vk::GraphicsPipelineCreateInfo(eCaptureStatisticsKHR | eCaptureInternalRepresentationsKHR, stages)
              .setPVertexInputState(&vertices)
              .setPInputAssemblyState(&assembly)
              .setPViewportState(&viewport)
              .setPRasterizationState(&raster)
              .setPMultisampleState(&samples)
              .setPColorBlendState(&blend)
              .setLayout(*on.layout)
              .setRenderPass(*pass)};
}

// A stage among the pipeline's executables.
vk::PipelineExecutableInfoKHR find_executable(const CompilingDevice& on, const vk::raii::Pipeline& pipeline,
                                              vk::ShaderStageFlagBits stage) {
  const auto all = on.device.getPipelineExecutablePropertiesKHR(vk::PipelineInfoKHR(*pipeline));
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    if (all[i].stages & stage) return {*pipeline, i};
  }
  throw vulkan_error(on.name, "does not report the vertex and the fragment stage");
}

std::map<std::string, std::uint64_t> read_statistics(const CompilingDevice& on,
                                                     const vk::PipelineExecutableInfoKHR& executable) {
  std::map<std::string, std::uint64_t> statistics;
  for (const auto& one : on.device.getPipelineExecutableStatisticsKHR(executable)) statistics[one.name] = one.value.u64;
  return statistics;
}

// The wrapper lists the texts with their sizes; the driver fills them in where there is room.
std::string read_compiled_code(const CompilingDevice& on, const vk::PipelineExecutableInfoKHR& executable) {
  auto all = on.device.getPipelineExecutableInternalRepresentationsKHR(executable);
  auto count = static_cast<std::uint32_t>(all.size());
  std::vector<std::string> texts(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    texts[i].resize(all[i].dataSize);
    all[i].pData = texts[i].data();
  }
  (void)on.device.getDispatcher()->vkGetPipelineExecutableInternalRepresentationsKHR(
      *on.device, reinterpret_cast<const VkPipelineExecutableInfoKHR*>(&executable), &count,
      reinterpret_cast<VkPipelineExecutableInternalRepresentationKHR*>(all.data()));
  for (std::uint32_t i = 0; i < count; ++i) {
    if (std::string_view(all[i].name) == "ACO IR" && !texts[i].empty()) return texts[i].substr(0, texts[i].find('\0'));
  }
  throw vulkan_error(on.name, "does not report the code of its compiler ACO");
}

// Turns the driver's exceptions into an Error.
auto translated(const auto& work) {
  try {
    return work();
  } catch (const vk::SystemError& error) {
    throw vulkan_error("Vulkan", error.what());
  }
}

CompiledStage compiled_on(const CompilingDevice& on, const SpirvProgram& program) {
  const auto begin = std::chrono::steady_clock::now();
  const vk::raii::Pipeline pipeline = create_pipeline(on, program);
  CompiledStage stage;
  stage.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto fragment = find_executable(on, pipeline, vk::ShaderStageFlagBits::eFragment);
  stage.statistics = read_statistics(on, fragment);
  stage.vertex_instructions =
      read_statistics(on, find_executable(on, pipeline, vk::ShaderStageFlagBits::eVertex))[instructions_statistic];
  stage.code = read_compiled_code(on, fragment);
  return stage;
}

}  // namespace

VulkanCompiler vulkan_compiler() {
  const auto on = translated([] { return std::make_shared<const CompilingDevice>(); });
  return {.device = on->name, .compile = [on](const SpirvProgram& program) {
            return translated([&] { return compiled_on(*on, program); });
          }};
}

}  // namespace footprint
