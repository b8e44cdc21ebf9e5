// Creates an instance, a device, one pipeline layout for all programs, and a graphics pipeline per program.
#include "renderer/gpu_cost/vulkan_compiler.hpp"

#define VK_NO_PROTOTYPES
#include <dlfcn.h>
#include <fmt/format.h>
#include <vulkan/vulkan.h>

#include <array>
#include <chrono>
#include <functional>
#include <vector>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

constexpr const char* packages = "install the packages libvulkan1 and mesa-vulkan-drivers (Mesa's driver for AMD)";
constexpr std::uint32_t most_textures = 32, most_blocks = 9, most_attributes = 16;

void require(VkResult result, const char* what) {
  if (result != VK_SUCCESS)
    throw Error(ErrorKind::machine, "Vulkan", fmt::format("{} fails with code {}", what, static_cast<int>(result)),
                packages);
}

// An empty structure of a type.
template <class Info>
Info info_of(VkStructureType type) {
  Info info{};
  info.sType = type;
  return info;
}

// Destroys a Vulkan object at the end of its scope.
template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, std::function<void(Handle)>>;

struct LibraryCloser {
  void operator()(void* library) const { dlclose(library); }
};

std::vector<VkDescriptorSetLayoutBinding> all_bindings() {
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  const auto add = [&](std::uint32_t binding, VkDescriptorType type) {
    bindings.push_back({binding, type, 1, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, nullptr});
  };
  for (std::uint32_t i = 0; i < most_textures; ++i) add(i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
  for (std::uint32_t i = 0; i < most_blocks; ++i)
    add(vulkan_binding::first_block + i, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
  add(vulkan_binding::plain_uniforms, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
  return bindings;
}

// The format of a target.
VkFormat format_of(const ColorTarget& target) {
  if (target.bits == 16)
    return target.channels == 1   ? VK_FORMAT_R16_SFLOAT
           : target.channels == 2 ? VK_FORMAT_R16G16_SFLOAT
                                  : VK_FORMAT_R16G16B16A16_SFLOAT;
  return target.channels == 1   ? VK_FORMAT_R32_SFLOAT
         : target.channels == 2 ? VK_FORMAT_R32G32_SFLOAT
                                : VK_FORMAT_R32G32B32A32_SFLOAT;
}

// The fixed state of every pipeline: float vertex attributes, and all channels of each target written.
struct FixedState {
  explicit FixedState(std::size_t targets) : written(targets) {
    for (std::uint32_t i = 0; i < most_attributes; ++i)
      attributes.at(i) = {i, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 16 * i};
    vertices.vertexBindingDescriptionCount = 1;
    vertices.pVertexBindingDescriptions = &stream;
    vertices.vertexAttributeDescriptionCount = most_attributes;
    vertices.pVertexAttributeDescriptions = attributes.data();
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    viewport.viewportCount = viewport.scissorCount = 1;
    viewport.pViewports = &area;
    viewport.pScissors = &scissor;
    raster.lineWidth = 1.0F;
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    for (VkPipelineColorBlendAttachmentState& target : written) target.colorWriteMask = 0xF;
    blend.attachmentCount = static_cast<std::uint32_t>(written.size());
    blend.pAttachments = written.data();
  }
  FixedState(const FixedState&) = delete;
  FixedState& operator=(const FixedState&) = delete;
  ~FixedState() = default;

  VkVertexInputBindingDescription stream{0, 16 * most_attributes, VK_VERTEX_INPUT_RATE_VERTEX};
  std::array<VkVertexInputAttributeDescription, most_attributes> attributes{};
  VkViewport area{0, 0, 512, 512, 0, 1};
  VkRect2D scissor{{0, 0}, {512, 512}};
  std::vector<VkPipelineColorBlendAttachmentState> written;
  VkPipelineVertexInputStateCreateInfo vertices =
      info_of<VkPipelineVertexInputStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
  VkPipelineInputAssemblyStateCreateInfo assembly =
      info_of<VkPipelineInputAssemblyStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
  VkPipelineViewportStateCreateInfo viewport =
      info_of<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
  VkPipelineRasterizationStateCreateInfo raster =
      info_of<VkPipelineRasterizationStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
  VkPipelineMultisampleStateCreateInfo samples =
      info_of<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
  VkPipelineColorBlendStateCreateInfo blend =
      info_of<VkPipelineColorBlendStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
};

}  // namespace

struct VulkanCompiler::Implementation {
  Implementation() : library(dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL)) {
    if (!library) throw Error(ErrorKind::machine, "libvulkan.so.1", "cannot be loaded", packages);
    instance_function = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library.get(), "vkGetInstanceProcAddr"));
    make_instance();
    make_device();
    make_layout();
  }

  // A function of the loader or an instance, before there is a device.
  template <class Function>
  [[nodiscard]] Function instance_find(VkInstance of, const char* function) const {
    return as_function<Function>(instance_function(of, function), function);
  }

  // A function of the device.
  template <class Function>
  [[nodiscard]] Function find(const char* function) const {
    return as_function<Function>(device_function(device.get(), function), function);
  }

  template <class Function>
  [[nodiscard]] static Function as_function(PFN_vkVoidFunction pointer, const char* function) {
    if (pointer == nullptr)
      throw Error(ErrorKind::machine, "Vulkan", fmt::format("the driver has no {}", function), packages);
    return reinterpret_cast<Function>(pointer);
  }

  void make_instance() {
    auto application = info_of<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.apiVersion = VK_API_VERSION_1_1;
    auto create = info_of<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    create.pApplicationInfo = &application;
    VkInstance made = nullptr;
    require(instance_find<PFN_vkCreateInstance>(nullptr, "vkCreateInstance")(&create, nullptr, &made),
            "creating an instance");
    const auto destroy = instance_find<PFN_vkDestroyInstance>(made, "vkDestroyInstance");
    instance = {made, [destroy](VkInstance i) { destroy(i, nullptr); }};
  }

  void make_device() {
    std::uint32_t count = 1;
    VkPhysicalDevice physical = nullptr;
    const VkResult found = instance_find<PFN_vkEnumeratePhysicalDevices>(instance.get(), "vkEnumeratePhysicalDevices")(
        instance.get(), &count, &physical);
    if (found < 0 || count == 0) throw Error(ErrorKind::machine, "Vulkan", "there is no device", packages);
    VkPhysicalDeviceProperties properties;
    instance_find<PFN_vkGetPhysicalDeviceProperties>(instance.get(), "vkGetPhysicalDeviceProperties")(physical,
                                                                                                      &properties);
    name = static_cast<const char*>(properties.deviceName);
    const float priority = 1.0F;
    auto queue = info_of<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    auto statistics = info_of<VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR);
    statistics.pipelineExecutableInfo = VK_TRUE;
    const char* const extension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
    VkPhysicalDeviceFeatures features{};
    features.samplerAnisotropy = VK_TRUE;
    features.shaderImageGatherExtended = VK_TRUE;
    auto create = info_of<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    create.pNext = &statistics;
    create.queueCreateInfoCount = 1;
    create.pQueueCreateInfos = &queue;
    create.enabledExtensionCount = 1;
    create.ppEnabledExtensionNames = &extension;
    create.pEnabledFeatures = &features;
    VkDevice made = nullptr;
    require(instance_find<PFN_vkCreateDevice>(instance.get(), "vkCreateDevice")(physical, &create, nullptr, &made),
            "creating a device");
    device_function = instance_find<PFN_vkGetDeviceProcAddr>(instance.get(), "vkGetDeviceProcAddr");
    const auto destroy = as_function<PFN_vkDestroyDevice>(device_function(made, "vkDestroyDevice"), "vkDestroyDevice");
    device = {made, [destroy](VkDevice d) { destroy(d, nullptr); }};
  }

  void make_layout() {
    const std::vector<VkDescriptorSetLayoutBinding> bindings = all_bindings();
    auto create = info_of<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    create.bindingCount = static_cast<std::uint32_t>(bindings.size());
    create.pBindings = bindings.data();
    VkDescriptorSetLayout set_made = nullptr;
    require(
        find<PFN_vkCreateDescriptorSetLayout>("vkCreateDescriptorSetLayout")(device.get(), &create, nullptr, &set_made),
        "creating a descriptor set layout");
    set = own<PFN_vkDestroyDescriptorSetLayout>(set_made, "vkDestroyDescriptorSetLayout");
    auto layout_create = info_of<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    layout_create.setLayoutCount = 1;
    layout_create.pSetLayouts = &set_made;
    VkPipelineLayout made = nullptr;
    require(find<PFN_vkCreatePipelineLayout>("vkCreatePipelineLayout")(device.get(), &layout_create, nullptr, &made),
            "creating a pipeline layout");
    layout = own<PFN_vkDestroyPipelineLayout>(made, "vkDestroyPipelineLayout");
  }

  // A pass that draws into these targets.
  [[nodiscard]] Owned<VkRenderPass> pass_of(const std::vector<ColorTarget>& targets) const {
    std::vector<VkAttachmentDescription> attachments;
    std::vector<VkAttachmentReference> references;
    for (const ColorTarget& target : targets) {
      references.push_back({static_cast<std::uint32_t>(references.size()), VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL});
      VkAttachmentDescription& attachment = attachments.emplace_back();
      attachment.format = format_of(target);
      attachment.samples = VK_SAMPLE_COUNT_1_BIT;
      attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
      attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
      attachment.finalLayout = VK_IMAGE_LAYOUT_GENERAL;
    }
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = static_cast<std::uint32_t>(references.size());
    subpass.pColorAttachments = references.data();
    auto create = info_of<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
    create.attachmentCount = static_cast<std::uint32_t>(attachments.size());
    create.pAttachments = attachments.data();
    create.subpassCount = 1;
    create.pSubpasses = &subpass;
    VkRenderPass made = nullptr;
    require(find<PFN_vkCreateRenderPass>("vkCreateRenderPass")(device.get(), &create, nullptr, &made),
            "creating a render pass");
    return own<PFN_vkDestroyRenderPass>(made, "vkDestroyRenderPass");
  }

  // Owns an object of the device.
  template <class Destroy, class Handle>
  [[nodiscard]] Owned<Handle> own(Handle handle, const char* destroy) const {
    return {handle,
            [device_handle = device.get(), end = find<Destroy>(destroy)](Handle h) { end(device_handle, h, nullptr); }};
  }

  [[nodiscard]] Owned<VkShaderModule> module_of(const Spirv& words) const {
    auto create = info_of<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    create.codeSize = words.size() * sizeof(Spirv::value_type);
    create.pCode = words.data();
    VkShaderModule made = nullptr;
    require(find<PFN_vkCreateShaderModule>("vkCreateShaderModule")(device.get(), &create, nullptr, &made),
            "reading SPIR-V");
    return own<PFN_vkDestroyShaderModule>(made, "vkDestroyShaderModule");
  }

  [[nodiscard]] Owned<VkPipeline> pipeline_of(const SpirvProgram& program) const {
    const Owned<VkShaderModule> vertex = module_of(program.vertex), fragment = module_of(program.fragment);
    std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
    for (VkPipelineShaderStageCreateInfo& stage : stages) {
      stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
      stage.pName = "main";
    }
    stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
    stages[0].module = vertex.get();
    stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
    stages[1].module = fragment.get();
    const FixedState state(program.targets.size());
    const Owned<VkRenderPass> pass = pass_of(program.targets);
    auto create = info_of<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
    create.flags =
        VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR | VK_PIPELINE_CREATE_CAPTURE_INTERNAL_REPRESENTATIONS_BIT_KHR;
    create.stageCount = stages.size();
    create.pStages = stages.data();
    create.pVertexInputState = &state.vertices;
    create.pInputAssemblyState = &state.assembly;
    create.pViewportState = &state.viewport;
    create.pRasterizationState = &state.raster;
    create.pMultisampleState = &state.samples;
    create.pColorBlendState = &state.blend;
    create.layout = layout.get();
    create.renderPass = pass.get();
    VkPipeline made = nullptr;
    require(find<PFN_vkCreateGraphicsPipelines>("vkCreateGraphicsPipelines")(device.get(), VK_NULL_HANDLE, 1, &create,
                                                                             nullptr, &made),
            "compiling a pipeline");
    return own<PFN_vkDestroyPipeline>(made, "vkDestroyPipeline");
  }

  // The number of the fragment stage among the pipeline's executables.
  [[nodiscard]] std::uint32_t fragment_of(VkPipeline pipeline) const {
    auto info = info_of<VkPipelineInfoKHR>(VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR);
    info.pipeline = pipeline;
    const auto list = find<PFN_vkGetPipelineExecutablePropertiesKHR>("vkGetPipelineExecutablePropertiesKHR");
    std::uint32_t count = 0;
    require(list(device.get(), &info, &count, nullptr), "listing executables");
    std::vector<VkPipelineExecutablePropertiesKHR> all(
        count, info_of<VkPipelineExecutablePropertiesKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR));
    require(list(device.get(), &info, &count, all.data()), "listing executables");
    for (std::uint32_t i = 0; i < count; ++i) {
      if ((all[i].stages & VK_SHADER_STAGE_FRAGMENT_BIT) != 0) return i;
    }
    throw Error(ErrorKind::machine, name, "reports no fragment stage", packages);
  }

  void read_statistics(const VkPipelineExecutableInfoKHR& executable, CompiledStage& stage) const {
    const auto list = find<PFN_vkGetPipelineExecutableStatisticsKHR>("vkGetPipelineExecutableStatisticsKHR");
    std::uint32_t count = 0;
    require(list(device.get(), &executable, &count, nullptr), "reading statistics");
    std::vector<VkPipelineExecutableStatisticKHR> all(
        count, info_of<VkPipelineExecutableStatisticKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR));
    require(list(device.get(), &executable, &count, all.data()), "reading statistics");
    for (const VkPipelineExecutableStatisticKHR& one : all)
      stage.statistics[static_cast<const char*>(one.name)] = one.value.u64;
  }

  void read_code(const VkPipelineExecutableInfoKHR& executable, CompiledStage& stage) const {
    const auto list = find<PFN_vkGetPipelineExecutableInternalRepresentationsKHR>(
        "vkGetPipelineExecutableInternalRepresentationsKHR");
    std::uint32_t count = 0;
    require(list(device.get(), &executable, &count, nullptr), "reading the code");
    std::vector<VkPipelineExecutableInternalRepresentationKHR> all(
        count, info_of<VkPipelineExecutableInternalRepresentationKHR>(
                   VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INTERNAL_REPRESENTATION_KHR));
    require(list(device.get(), &executable, &count, all.data()), "reading the code");
    std::vector<std::string> texts(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      texts[i].resize(all[i].dataSize);
      all[i].pData = texts[i].data();
    }
    require(list(device.get(), &executable, &count, all.data()), "reading the code");
    for (std::uint32_t i = 0; i < count; ++i) {
      if (std::string_view(static_cast<const char*>(all[i].name)) == "ACO IR") stage.code = texts[i].c_str();
    }
    if (stage.code.empty())
      throw Error(ErrorKind::machine, name, "does not report the code of its compiler ACO", packages);
  }

  std::unique_ptr<void, LibraryCloser> library;
  PFN_vkGetInstanceProcAddr instance_function = nullptr;
  PFN_vkGetDeviceProcAddr device_function = nullptr;
  std::string name;
  Owned<VkInstance> instance;
  Owned<VkDevice> device;
  Owned<VkDescriptorSetLayout> set;
  Owned<VkPipelineLayout> layout;
};

VulkanCompiler::VulkanCompiler() : implementation_(std::make_unique<Implementation>()) {}

VulkanCompiler::~VulkanCompiler() = default;

const std::string& VulkanCompiler::device() const { return implementation_->name; }

CompiledStage VulkanCompiler::compile(const SpirvProgram& program) const {
  const auto begin = std::chrono::steady_clock::now();
  const Owned<VkPipeline> pipeline = implementation_->pipeline_of(program);
  CompiledStage stage;
  stage.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  auto executable = info_of<VkPipelineExecutableInfoKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR);
  executable.pipeline = pipeline.get();
  executable.executableIndex = implementation_->fragment_of(pipeline.get());
  implementation_->read_statistics(executable, stage);
  implementation_->read_code(executable, stage);
  return stage;
}

}  // namespace footprint
