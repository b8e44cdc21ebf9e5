// A Vulkan layer that hides VK_EXT_graphics_pipeline_library. Mesa 22.3's zink describes its pipeline libraries with
// formats of attachments that it leaves undefined, and the validation layer, which copies as many as are named, falls over
// them. Without the extension zink makes whole pipelines, which name theirs.
#include <stdlib.h>
#include <string.h>
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

static PFN_vkGetInstanceProcAddr next_address;
static PFN_vkEnumerateDeviceExtensionProperties next_extensions;

// The loader's link to the next layer; null where there is none.
static VkLayerInstanceCreateInfo* link_of(const VkInstanceCreateInfo* info) {
  VkLayerInstanceCreateInfo* link = (VkLayerInstanceCreateInfo*)info->pNext;
  while (link != NULL &&
         (link->sType != VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO || link->function != VK_LAYER_LINK_INFO))
    link = (VkLayerInstanceCreateInfo*)link->pNext;
  return link;
}

static VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                                           VkInstance* instance) {
  VkLayerInstanceCreateInfo* link = link_of(info);
  if (link == NULL) return VK_ERROR_INITIALIZATION_FAILED;
  next_address = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const PFN_vkCreateInstance next = (PFN_vkCreateInstance)next_address(VK_NULL_HANDLE, "vkCreateInstance");
  const VkResult result = next(info, allocator, instance);
  if (result == VK_SUCCESS)
    next_extensions = (PFN_vkEnumerateDeviceExtensionProperties)next_address(*instance,
                                                                             "vkEnumerateDeviceExtensionProperties");
  return result;
}

static VkResult VKAPI_CALL device_extensions(VkPhysicalDevice device, const char* layer, uint32_t* count,
                                             VkExtensionProperties* out) {
  uint32_t all = 0, passed = 0;
  VkResult result = next_extensions(device, layer, &all, NULL);
  if (result != VK_SUCCESS) return result;
  VkExtensionProperties* list = calloc(all + 1, sizeof *list);
  if (list == NULL) return VK_ERROR_OUT_OF_HOST_MEMORY;
  result = next_extensions(device, layer, &all, list);
  for (uint32_t i = 0; i < all; ++i) {
    if (strcmp(list[i].extensionName, VK_EXT_GRAPHICS_PIPELINE_LIBRARY_EXTENSION_NAME) != 0) list[passed++] = list[i];
  }
  const uint32_t room = out == NULL ? passed : *count;
  *count = room < passed ? room : passed;
  if (out != NULL) memcpy(out, list, *count * sizeof *list);
  free(list);
  return result == VK_SUCCESS && *count < passed ? VK_INCOMPLETE : result;
}

// The entry points that the loader looks for.
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance instance, const char* name) {
  if (strcmp(name, "vkGetInstanceProcAddr") == 0) return (PFN_vkVoidFunction)vkGetInstanceProcAddr;
  if (strcmp(name, "vkCreateInstance") == 0) return (PFN_vkVoidFunction)create_instance;
  if (strcmp(name, "vkEnumerateDeviceExtensionProperties") == 0) return (PFN_vkVoidFunction)device_extensions;
  return next_address == NULL ? NULL : next_address(instance, name);
}
