#include "samples/scenes/gallery.h"

#include "samples/scenes/assembly.h"
#include "samples/scenes/builtin_scenes.h"

namespace licht {

Scene makeGallery() {
    Scene scene;
    scene.name = "gallery";
    const gallery::Materials materials = gallery::addMaterials(scene);
    gallery::addRoom(scene, materials);
    gallery::addPassage(scene, materials);
    gallery::addFurniture(scene, materials);
    gallery::addArt(scene, materials);
    gallery::addPlant(scene, materials);
    gallery::addLamps(scene, materials);
    scene.environment = gallery::afternoonSky();
    scene.default_exposure = 1.0;

    scene.cameras.push_back(lookingCamera("room", {0.75F, 1.5F, 4.1F}, {0.05F, 1.2F, -2.0F}, 0.7F));
    scene.cameras.push_back(lookingCamera("table", {0.9F, 1.15F, 0.9F}, {-0.3F, 0.5F, -1.0F}, 0.6F));
    return scene;
}

}  // namespace licht
